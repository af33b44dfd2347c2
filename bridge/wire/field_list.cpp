// SPDX-License-Identifier: Apache-2.0
#include "wire/field_list.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>

#include "domain/message_fields.hpp"

namespace clew::bridge {
namespace {

/// An enumerator's name; its number, if it has none.
template <typename Enum>
FieldValue enumerator_value(Enum value) {
  const auto index = static_cast<std::size_t>(value);
  if (index >= domain::kEnumeratorNames<Enum>.size()) return std::uint64_t{index};
  return std::string_view(domain::kEnumeratorNames<Enum>[index]);
}

/// Collects the fields of a message; `path_` is where it is at the moment.
class FieldLister {
 public:
  template <typename Member>
  void operator()(const char* name, const Member& member) {
    const std::size_t outer = path_.size();
    if (outer > 0) path_ += '.';
    path_ += name;
    list(member);
    path_.resize(outer);
  }

  std::vector<Field> take() { return std::move(fields_); }

 private:
  template <typename Member>
  void list(const Member& member) {
    if constexpr (std::is_enum_v<Member>) {
      add(enumerator_value(member));
    } else if constexpr (std::is_same_v<Member, bool> || std::is_same_v<Member, double> ||
                         std::is_same_v<Member, std::string>) {
      add(member);
    } else if constexpr (std::is_integral_v<Member>) {
      add(static_cast<std::uint64_t>(member));
    } else if constexpr (domain::kIsStruct<Member>) {
      domain::visit_named_fields(*this, member);
    } else {
      list_items(member);
    }
  }

  template <typename List>
  void list_items(const List& items) {
    const std::size_t outer = path_.size();
    if constexpr (domain::kIsSequence<List>) {
      path_ += ".length";
      add(static_cast<std::uint64_t>(items.size()));
      path_.resize(outer);
    }
    std::size_t i = 0;
    for (const auto& item : items) {
      path_ += '[' + std::to_string(i++) + ']';
      list(item);
      path_.resize(outer);
    }
  }

  void add(FieldValue value) { fields_.push_back({path_, std::move(value)}); }

  std::string path_;
  std::vector<Field> fields_;
};

/// Collects the names of the fields that a message can have; `path_` is where it is at the moment.
class NameLister {
 public:
  template <typename Member>
  void operator()(const char* name, const Member& member) {
    const std::size_t outer = path_.size();
    if (outer > 0) path_ += '.';
    path_ += name;
    list(member);
    path_.resize(outer);
  }

  std::vector<std::string> take() { return std::move(names_); }

 private:
  template <typename Member>
  void list(const Member& member) {
    if constexpr (domain::kIsStruct<Member>) {
      domain::visit_named_fields(*this, member);
    } else if constexpr (domain::kIsSequence<Member> || domain::kIsArray<Member>) {
      list(std::decay_t<decltype(*member.begin())>{});
    } else {
      names_.push_back(path_);
    }
  }

  std::string path_;
  std::vector<std::string> names_;
};

std::uint64_t bits_of(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

std::string number_text(double value) {
  if (std::isnan(value)) return fmt::format("nan(0x{:016x})", bits_of(value));
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value);
  return {digits, end.ptr};
}

struct ValueText {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::uint64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return number_text(value); }
  std::string operator()(const std::string& value) const {
    std::string text = "\"";
    for (const char c : value) {
      const auto code = static_cast<unsigned char>(c);
      if (code < ' ' || code == 0x7f) {
        text += fmt::format("\\x{:02x}", static_cast<unsigned>(code));
        continue;
      }
      if (c == '"' || c == '\\') text += '\\';
      text += c;
    }
    return text + '"';
  }
  std::string operator()(std::string_view name) const { return std::string(name); }
};

bool within(const FieldValue& a, const FieldValue& b, double tolerance) {
  if (same_bits(a, b)) return true;
  const auto* number_a = std::get_if<double>(&a);
  const auto* number_b = std::get_if<double>(&b);
  return tolerance > 0.0 && number_a != nullptr && number_b != nullptr &&
         std::fabs(*number_a - *number_b) <= tolerance;
}

std::vector<FieldDifference> differences_of(const std::vector<Field>& a,
                                            const std::vector<Field>& b, double tolerance) {
  std::map<std::string_view, const FieldValue*> rest_of_b;
  for (const Field& field : b) rest_of_b.emplace(field.path, &field.value);
  std::vector<FieldDifference> found;
  for (const Field& field : a) {
    const auto other = rest_of_b.find(field.path);
    if (other == rest_of_b.end()) {
      found.push_back({field.path, field.value, std::nullopt});
      continue;
    }
    if (!within(field.value, *other->second, tolerance)) {
      found.push_back({field.path, field.value, *other->second});
    }
    rest_of_b.erase(other);
  }
  for (const Field& field : b) {
    if (rest_of_b.count(field.path) != 0) {
      found.push_back({field.path, std::nullopt, field.value});
    }
  }
  return found;
}

}  // namespace

bool same_bits(const FieldValue& a, const FieldValue& b) {
  const auto* number_a = std::get_if<double>(&a);
  const auto* number_b = std::get_if<double>(&b);
  if (number_a != nullptr && number_b != nullptr) return bits_of(*number_a) == bits_of(*number_b);
  return a == b;
}

std::string field_text(const FieldValue& value) { return std::visit(ValueText{}, value); }

std::vector<Field> fields_of(domain::ConstMessagePointer message) {
  FieldLister lister;
  std::visit([&](const auto* m) { domain::visit_named_fields(lister, *m); }, message);
  return lister.take();
}

std::vector<std::string> field_names(domain::Topic topic) {
  return domain::visit_topic(topic, [](auto constant) {
    NameLister lister;
    const typename decltype(constant)::Message message{};
    domain::visit_named_fields(lister, message);
    return lister.take();
  });
}

std::vector<FieldDifference> differences(domain::ConstMessagePointer a,
                                         domain::ConstMessagePointer b, double tolerance) {
  return differences_of(fields_of(a), fields_of(b), tolerance);
}

}  // namespace clew::bridge
