// SPDX-License-Identifier: Apache-2.0
#include "convert/message_fields.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <type_traits>

#include "convert/named_fields.hpp"

namespace clew::bridge {
namespace {

using domain::CommandKind;
using domain::EventKind;
using domain::GuidanceMode;
using domain::Network;
using domain::Outcome;

// As in idl/, in the order of the enumerators.
template <typename Enum>
constexpr std::array<const char*, 0> kNames{};
template <>
constexpr std::array kNames<CommandKind> = {"COMMAND_STOP", "COMMAND_TURN_AND_STEP",
                                            "COMMAND_VELOCITIES", "COMMAND_WHEEL_SPEEDS",
                                            "COMMAND_GIVE_UP"};
template <>
constexpr std::array kNames<EventKind> = {
    "EVENT_LANDMARK",     "EVENT_REFLEX",        "EVENT_TRAP",           "EVENT_ESCAPE_BEGUN",
    "EVENT_ESCAPE_ENDED", "EVENT_ESCAPE_FAILED", "EVENT_VIRTUAL_TARGET", "EVENT_UNREACHABLE"};
template <>
constexpr std::array kNames<GuidanceMode> = {"GUIDANCE_SEEK", "GUIDANCE_RECOVER",
                                             "GUIDANCE_UNREACHABLE"};
template <>
constexpr std::array kNames<Network> = {"NETWORK_SOM", "NETWORK_FUZZY_ART"};
template <>
constexpr std::array kNames<Outcome> = {"OUTCOME_RUNNING", "OUTCOME_REACHED", "OUTCOME_COLLIDED",
                                        "OUTCOME_UNREACHABLE", "OUTCOME_TIMEOUT"};

/// An enumerator's name; its number, if it has none.
template <typename Enum>
FieldValue enumerator_value(Enum value) {
  const auto index = static_cast<std::size_t>(value);
  if (index >= kNames<Enum>.size()) return std::uint64_t{index};
  return std::string_view(kNames<Enum>[index]);
}

template <typename T, typename = void>
struct IsList : std::false_type {};
template <typename T>
struct IsList<T, std::void_t<decltype(std::declval<const T&>().begin())>>
    : std::bool_constant<!std::is_same_v<T, std::string>> {};

template <typename T>
struct HasFixedLength : std::false_type {};
template <typename T, std::size_t N>
struct HasFixedLength<std::array<T, N>> : std::true_type {};

/// Collects the fields of a message; `path_` is where it is at the moment.
class FieldLister {
 public:
  template <typename Member>
  void operator()(const char* name, Member& member) {
    const std::size_t outer = path_.size();
    if (outer > 0) path_ += '.';
    path_ += name;
    list(member);
    path_.resize(outer);
  }

  std::vector<Field> take() { return std::move(fields_); }

 private:
  template <typename Member>
  void list(Member& member) {
    if constexpr (std::is_enum_v<Member>) {
      add(enumerator_value(member));
    } else if constexpr (std::is_same_v<Member, bool> || std::is_same_v<Member, double> ||
                         std::is_same_v<Member, std::string>) {
      add(member);
    } else if constexpr (std::is_integral_v<Member>) {
      add(static_cast<std::uint64_t>(member));
    } else if constexpr (IsList<Member>::value) {
      list_items(member);
    } else {
      visit_named_fields(*this, member);
    }
  }

  template <typename List>
  void list_items(List& items) {
    const std::size_t outer = path_.size();
    if constexpr (!HasFixedLength<List>::value) {
      path_ += ".length";
      add(static_cast<std::uint64_t>(items.size()));
      path_.resize(outer);
    }
    std::size_t i = 0;
    for (auto& item : items) {
      path_ += '[' + std::to_string(i++) + ']';
      list(item);
      path_.resize(outer);
    }
  }

  void add(FieldValue value) { fields_.push_back({path_, std::move(value)}); }

  std::string path_;
  std::vector<Field> fields_;
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

template <typename Message>
std::vector<Field> fields_of(const Message& message) {
  FieldLister lister;
  // visit_named_fields takes a message by reference, to serve visitors that change it too.
  visit_named_fields(lister, const_cast<Message&>(message));
  return lister.take();
}

template <typename Message>
std::vector<FieldDifference> differences(const Message& a, const Message& b, double tolerance) {
  return differences_of(fields_of(a), fields_of(b), tolerance);
}

template std::vector<Field> fields_of(const domain::Command&);
template std::vector<Field> fields_of(const domain::Event&);
template std::vector<Field> fields_of(const domain::Guidance&);
template std::vector<Field> fields_of(const domain::Landmark&);
template std::vector<Field> fields_of(const domain::Odometry&);
template std::vector<Field> fields_of(const domain::Scan&);
template std::vector<Field> fields_of(const domain::State&);
template std::vector<Field> fields_of(const domain::Target&);

template std::vector<FieldDifference> differences(const domain::Command&, const domain::Command&,
                                                  double);
template std::vector<FieldDifference> differences(const domain::Event&, const domain::Event&,
                                                  double);
template std::vector<FieldDifference> differences(const domain::Guidance&, const domain::Guidance&,
                                                  double);
template std::vector<FieldDifference> differences(const domain::Landmark&, const domain::Landmark&,
                                                  double);
template std::vector<FieldDifference> differences(const domain::Odometry&, const domain::Odometry&,
                                                  double);
template std::vector<FieldDifference> differences(const domain::Scan&, const domain::Scan&, double);
template std::vector<FieldDifference> differences(const domain::State&, const domain::State&,
                                                  double);
template std::vector<FieldDifference> differences(const domain::Target&, const domain::Target&,
                                                  double);

}  // namespace clew::bridge
