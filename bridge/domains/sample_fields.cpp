// SPDX-License-Identifier: Apache-2.0
#include "domains/sample_fields.hpp"

#include <algorithm>
#include <charconv>
#include <type_traits>
#include <utility>

#include "domain/message_fields.hpp"
#include "domain/topics.hpp"
#include "ros2/message_codec.hpp"
#include "ros2/message_type.hpp"
#include "wire/codec.hpp"

namespace clew::domains {
namespace {

using core::Error;
using core::Result;

/// Walks down a message along a path.
class FieldSearch {
 public:
  /// `any_item`: a list has every item, of the value that a fresh one has.
  FieldSearch(const FieldPath& path, bool any_item) : path_(path), any_item_(any_item) {}

  template <typename Struct>
  std::optional<FieldValue> find_in(const Struct& message) {
    search(message, 0);
    return std::move(found_);
  }

 private:
  template <typename Value>
  void search(const Value& value, std::size_t depth) {
    if constexpr (domain::kIsStruct<Value>) {
      search_members(value, depth);
    } else if constexpr (domain::kIsSequence<Value> || domain::kIsArray<Value>) {
      search_list(value, depth);
    } else if (depth == path_.steps.size()) {
      found_ = single(value);
    }
  }

  template <typename Struct>
  void search_members(const Struct& value, std::size_t depth) {
    if (depth == path_.steps.size()) return;
    domain::visit_named_fields(
        [&](const char* name, const auto& member) {
          if (path_.steps[depth].name == name) search(member, depth + 1);
        },
        value);
  }

  template <typename List>
  void search_list(const List& list, std::size_t depth) {
    if (depth == path_.steps.size()) return;
    const FieldPath::Step& step = path_.steps[depth];
    if (!step.name.empty()) {
      const bool is_length = step.name == "length" && depth + 1 == path_.steps.size();
      if (is_length) found_ = static_cast<double>(list.size());
      return;
    }
    if (any_item_) {
      search(std::decay_t<decltype(*list.begin())>{}, depth + 1);
    } else if (step.index < list.size()) {
      search(*(list.begin() + static_cast<std::ptrdiff_t>(step.index)), depth + 1);
    }
  }

  template <typename Value>
  static FieldValue single(const Value& value) {
    if constexpr (std::is_same_v<Value, bool> || std::is_same_v<Value, std::string>) {
      return value;
    } else if constexpr (std::is_enum_v<Value>) {
      const auto index = static_cast<std::size_t>(value);
      const auto& names = domain::kEnumeratorNames<Value>;
      return index < names.size() ? std::string(names[index]) : std::to_string(index);
    } else {
      return static_cast<double>(value);
    }
  }

  const FieldPath& path_;
  bool any_item_;
  std::optional<FieldValue> found_;
};

/// Calls `use` with a fresh message of a type, and with what decodes one; false for a type that is
/// unknown.
template <typename Use, typename... Messages>
bool use_ros_type(const std::string& type, const Use& use) {
  const auto use_if = [&](auto message) {
    using Message = decltype(message);
    if (type != ros2::message_type<Message>().dds_name) return false;
    use(message, [](std::string_view cdr, Message& to) { return ros2::decode(cdr, to); });
    return true;
  };
  return (use_if(Messages{}) || ...);
}

template <typename Use>
bool use_type(const std::string& type, const Use& use) {
  for (const domain::Topic topic : domain::kAllTopics) {
    if (domain::type_name(topic) != type) continue;
    domain::visit_topic(topic, [&](auto constant) {
      typename decltype(constant)::Message message;
      use(message, [](std::string_view cdr, auto& to) {
        return bridge::decode(cdr, &to, bridge::Values::kAny);
      });
    });
    return true;
  }
  return use_ros_type<Use, ros2::Clock, ros2::PoseStamped, ros2::Twist, ros2::TwistStamped,
                      ros2::TFMessage, ros2::Odometry, ros2::OccupancyGrid, ros2::Path,
                      ros2::LaserScan, ros2::DiagnosticArray, ros2::Log, ros2::MarkerArray>(type,
                                                                                            use);
}

/// `ranges_m[3]`: a member, and items of lists.
bool read_member(std::string_view text, FieldPath& path) {
  const std::size_t bracket = text.find('[');
  const std::string_view name = text.substr(0, bracket);
  if (name.empty()) return false;
  path.steps.push_back({std::string(name), 0});
  text.remove_prefix(std::min(bracket, text.size()));
  while (!text.empty()) {
    FieldPath::Step item;
    const auto [stop, error] =
        std::from_chars(text.data() + 1, text.data() + text.size(), item.index);
    const std::string_view rest = text.substr(static_cast<std::size_t>(stop - text.data()));
    if (text.front() != '[' || error != std::errc() || rest.empty() || rest.front() != ']') {
      return false;
    }
    path.steps.push_back(item);
    text = rest.substr(1);
  }
  return true;
}

}  // namespace

Result<FieldPath> FieldPath::parse(const std::string& text) {
  FieldPath path;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('.', begin), text.size());
    if (!read_member(std::string_view(text).substr(begin, end - begin), path)) {
      return Error{"'" + text + "' names no field; expected a path such as ranges_m[3]"};
    }
    begin = end + 1;
  }
  return path;
}

bool knows_fields_of(const std::string& type) {
  return use_type(type, [](const auto&, const auto&) {});
}

std::optional<FieldValue> kind_of_field(const std::string& type, const FieldPath& path) {
  std::optional<FieldValue> found;
  use_type(type, [&](const auto& message, const auto&) {
    found = FieldSearch(path, true).find_in(message);
  });
  return found;
}

Result<std::optional<FieldValue>> read_field(const std::string& type, std::string_view cdr,
                                             const FieldPath& path) {
  Result<std::optional<FieldValue>> found = Error{"the fields of " + type + " are unknown"};
  use_type(type, [&](auto& message, const auto& decode) {
    const Result<void> decoded = decode(cdr, message);
    if (decoded.ok()) {
      found = FieldSearch(path, false).find_in(message);
    } else {
      found = decoded.error();
    }
  });
  return found;
}

}  // namespace clew::domains
