// SPDX-License-Identifier: Apache-2.0
#include "wire/older_type.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "domain/message_fields.hpp"
#include "domain/reset.hpp"
#include "wire/cdr_writer.hpp"
#include "wire/idl_types.hpp"

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;
using Kind = IdlType::Kind;
using List = IdlType::List;

/// Reads the bytes of an older type into a message of today's, field by field by their names.
class OlderReader {
 public:
  OlderReader(const IdlTypes& types, std::string_view bytes) : types_(types), bytes_(bytes) {}

  template <typename Struct>
  void read_struct(std::size_t index, Struct& value) {
    for (const IdlTypes::Member& member : types_.structs()[index].members) {
      bool known = false;
      domain::for_each_field<Struct>([&](const auto& field) {
        if (known || member.name != field.name) return;
        known = true;
        at_ = &member;
        read(member.type, value.*field.member, field.rule);
      });
      if (!known) skip(member.type);
      if (!ok()) return;
    }
  }

  bool ok() const { return fault_.empty(); }
  /// What is wrong; empty if nothing is.
  const std::string& fault() const { return fault_; }

 private:
  template <typename Value, typename Rule>
  void read(const IdlType& type, Value& value, const Rule& rule) {
    if constexpr (domain::kIsSequence<Value>) {
      if (type.list != List::kSequence) return fail("was no sequence");
      const std::uint32_t length = take<std::uint32_t>();
      const std::size_t bound = domain::length_bound<Value>(rule);
      if (length > bound) return fail(fmt::format("is {} long; allowed: {}", length, bound));
      value.resize(length);
      read_items(type, value, rule);
    } else if constexpr (domain::kIsArray<Value>) {
      if (type.list != List::kArray || type.items != value.size()) {
        return fail(fmt::format("was no array of {}", value.size()));
      }
      read_items(type, value, rule);
    } else {
      if (type.list != List::kNone) return fail("was a list");
      read_item(type, value, rule);
    }
  }

  template <typename Values, typename Rule>
  void read_items(const IdlType& type, Values& values, const Rule& rule) {
    for (std::size_t i = 0; i < values.size() && ok(); ++i) {
      read_item(type, values[i], domain::item_rule(rule));
    }
  }

  template <typename Value, typename Rule>
  void read_item(const IdlType& type, Value& value, const Rule& rule) {
    if constexpr (domain::kIsStruct<Value>) {
      if (type.kind != Kind::kStruct) return fail("was no struct");
      read_struct(type.index, value);
    } else if constexpr (std::is_same_v<Value, std::string>) {
      if (type.kind != Kind::kText) return fail("was no text");
      const std::string_view text = take_text();
      if (text.size() > rule.bytes) {
        return fail(fmt::format("is {} bytes long; allowed: {}", text.size(), rule.bytes));
      }
      value = text;
    } else if constexpr (std::is_enum_v<Value>) {
      if (type.kind != Kind::kEnumeration) return fail("was no enumerator");
      value = enumerator<Value>(type.index, take<std::uint32_t>());
    } else if constexpr (std::is_same_v<Value, bool>) {
      if (type.kind != Kind::kBoolean) return fail("was no truth value");
      value = take<std::uint8_t>() != 0;
    } else if constexpr (std::is_same_v<Value, double>) {
      if (type.kind != Kind::kDouble) return fail("was no number");
      value = take<double>();
    } else {
      if (type.kind != Kind::kUnsigned) return fail("was no whole number");
      const std::uint64_t number = take_whole(type.size);
      if (number > std::numeric_limits<Value>::max()) return fail("is too large");
      value = static_cast<Value>(number);
    }
  }

  /// The one of that name; one that is gone has no name, as one beyond the last.
  template <typename Enum>
  Enum enumerator(std::size_t index, std::uint32_t number) const {
    constexpr auto kNone =
        static_cast<Enum>(std::numeric_limits<std::underlying_type_t<Enum>>::max());
    const auto& before = types_.enumerations()[index].enumerators;
    if (number >= before.size()) return kNone;
    const auto& names = domain::kEnumeratorNames<Enum>;
    const auto found = std::find(names.begin(), names.end(), before[number]);
    return found == names.end() ? kNone : static_cast<Enum>(found - names.begin());
  }

  /// Passes over a field that this version does not have. Every item takes a byte at least, so a
  /// list costs no more than its bytes.
  void skip(const IdlType& type) {
    std::uint32_t count = 1;
    if (type.list == List::kSequence) count = take<std::uint32_t>();
    if (type.list == List::kArray) count = type.items;
    for (std::uint32_t i = 0; i < count && ok(); ++i) skip_item(type);
  }
  void skip_item(const IdlType& type) {
    if (type.kind == Kind::kText) {
      take_text();
    } else if (type.kind != Kind::kStruct) {
      take_whole(type.size);
    } else {
      for (const IdlTypes::Member& member : types_.structs()[type.index].members) {
        if (ok()) skip(member.type);
      }
    }
  }

  std::uint64_t take_whole(std::size_t size) {
    if (size == 1) return take<std::uint8_t>();
    if (size == 2) return take<std::uint16_t>();
    if (size == 4) return take<std::uint32_t>();
    return take<std::uint64_t>();
  }
  template <typename Number>
  Number take() {
    Number number{};
    const std::size_t padding = cdr_padding<sizeof number>(position_);
    const std::size_t left = bytes_.size() - position_;
    if (padding > left || sizeof number > left - padding) {
      fail("is not there: the sample is too short");
      return {};
    }
    std::memcpy(&number, bytes_.data() + position_ + padding, sizeof number);
    position_ += padding + sizeof number;
    return number;
  }
  std::string_view take_text() {
    const std::uint32_t length = take<std::uint32_t>();
    if (!ok()) return {};
    if (length == 0 || length > bytes_.size() - position_ ||
        bytes_[position_ + length - 1] != '\0') {
      fail("is no text with a zero byte at its end");
      return {};
    }
    const std::string_view text = bytes_.substr(position_, length - 1);
    position_ += length;
    return text;
  }

  void fail(const std::string& what) {
    if (ok()) fault_ = (at_ != nullptr ? at_->name : std::string("it")) + ' ' + what;
  }

  const IdlTypes& types_;
  std::string_view bytes_;
  std::size_t position_ = 0;
  const IdlTypes::Member* at_ = nullptr;  ///< the field that is read
  std::string fault_;
};

}  // namespace

Result<OlderType> OlderType::parse(domain::Topic topic, std::string_view idl) {
  auto types = IdlTypes::parse(idl);
  if (!types.ok()) return types.error();
  const std::string_view type = domain::type_name(topic);
  const std::string_view name = type.substr(type.rfind(':') + 1);
  for (std::size_t i = 0; i < types->structs().size(); ++i) {
    if (types->structs()[i].name != name) continue;
    return OlderType(topic, std::make_shared<const IdlTypes>(std::move(types).value()), i);
  }
  return Error{"it declares no struct " + std::string(name)};
}

Result<std::string_view> OlderType::to_current(std::string_view cdr,
                                               std::vector<char>& buffer) const {
  if (cdr.size() < kCdrHeaderSize || std::memcmp(cdr.data(), kCdrHeader, 2) != 0) {
    return Error{"its sample has another encapsulation than XCDR1 little-endian"};
  }
  return domain::visit_topic(topic_, [&](auto constant) -> Result<std::string_view> {
    using Message = typename decltype(constant)::Message;
    Message message;
    OlderReader reader(*types_, cdr.substr(kCdrHeaderSize));
    reader.read_struct(root_, message);
    if (!reader.ok()) return Error{reader.fault()};
    buffer.resize(max_cdr_size<Message>());
    std::memcpy(buffer.data(), kCdrHeader, kCdrHeaderSize);
    CdrWriter writer(buffer.data() + kCdrHeaderSize, buffer.size() - kCdrHeaderSize);
    writer.write(message);
    return std::string_view(buffer.data(), kCdrHeaderSize + writer.size());
  });
}

bool OlderType::has_field(std::string_view path) const {
  std::size_t index = root_;
  while (true) {
    const std::size_t end = std::min(path.find_first_of(".["), path.size());
    const auto& members = types_->structs()[index].members;
    const auto member = std::find_if(members.begin(), members.end(), [&](const auto& one) {
      return one.name == path.substr(0, end);
    });
    if (member == members.end()) return false;
    const std::size_t dot = path.find('.', end);
    // `.length` of a list is none of a struct's fields.
    if (member->type.kind != Kind::kStruct || dot == std::string_view::npos ||
        path.substr(dot) == ".length") {
      return true;
    }
    index = member->type.index;
    path = path.substr(dot + 1);
  }
}

}  // namespace clew::bridge
