// SPDX-License-Identifier: Apache-2.0
#include "domains/condition.hpp"

#include <array>
#include <charconv>
#include <optional>
#include <sstream>

namespace clew::domains {
namespace {

using core::Error;
using core::Result;
using Operator = Condition::Operator;

struct OperatorName {
  Operator value;
  const char* name;
};
constexpr std::array<OperatorName, 6> kOperators = {{{Operator::kEqual, "=="},
                                                     {Operator::kUnequal, "!="},
                                                     {Operator::kLess, "<"},
                                                     {Operator::kAtMost, "<="},
                                                     {Operator::kGreater, ">"},
                                                     {Operator::kAtLeast, ">="}}};

bool is_of_order(Operator compare) {
  return compare != Operator::kEqual && compare != Operator::kUnequal;
}

std::optional<double> number_of(const std::string& text) {
  double number = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  return number;
}

/// A NaN is unequal to all, and in no order.
bool compare_numbers(double found, Operator compare, double wanted) {
  switch (compare) {
    case Operator::kEqual:
      return found == wanted;
    case Operator::kUnequal:
      return found != wanted;
    case Operator::kLess:
      return found < wanted;
    case Operator::kAtMost:
      return found <= wanted;
    case Operator::kGreater:
      return found > wanted;
    case Operator::kAtLeast:
      return found >= wanted;
  }
  return false;
}

}  // namespace

Result<Condition> Condition::parse(const std::string& text) {
  std::istringstream words(text);
  std::string field;
  std::string name;
  Condition condition;
  condition.text = text;
  std::string more;
  words >> field >> name >> condition.value >> more;
  if (condition.value.empty() || !more.empty()) {
    return Error{"expected FIELD OPERATOR VALUE, found '" + text + "'"};
  }
  auto path = FieldPath::parse(field);
  if (!path.ok()) return path.error();
  condition.field = std::move(path).value();
  for (const OperatorName& known : kOperators) {
    if (name != known.name) continue;
    condition.compare = known.value;
    return condition;
  }
  return Error{"'" + name + "' is no operator; allowed: == != < <= > >="};
}

Result<void> Condition::check(const std::string& type) const {
  const auto refuse = [&](const std::string& why) { return Error{"'" + text + "': " + why}; };
  if (!knows_fields_of(type)) {
    return refuse("the fields of " + type +
                  " are unknown; known are Clew's types and those that bridge/ros2 speaks");
  }
  const auto kind = kind_of_field(type, field);
  if (!kind) return refuse(type + " has no such field");
  if (std::holds_alternative<double>(*kind)) {
    if (!number_of(value)) return refuse("the field is a number, and '" + value + "' is none");
    return {};
  }
  if (is_of_order(compare)) return refuse("only numbers are in an order; allowed here: == !=");
  if (std::holds_alternative<bool>(*kind) && value != "true" && value != "false") {
    return refuse("the field is true or false");
  }
  return {};
}

Result<bool> Condition::holds(const std::string& type, std::string_view cdr) const {
  const auto found = read_field(type, cdr, field);
  if (!found.ok()) return found.error();
  if (!*found) return false;
  if (const auto* number = std::get_if<double>(&**found)) {
    return compare_numbers(*number, compare, number_of(value).value_or(0.0));
  }
  const auto* flag = std::get_if<bool>(&**found);
  const std::string word =
      flag == nullptr ? std::get<std::string>(**found) : std::string(*flag ? "true" : "false");
  return (word == value) == (compare == Operator::kEqual);
}

}  // namespace clew::domains
