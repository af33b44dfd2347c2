// SPDX-License-Identifier: Apache-2.0
#include "hunt/property.hpp"

#include <algorithm>
#include <cmath>

#include "hunt/property_node.hpp"

namespace clew::hunt {
namespace {

using Node = Property::Node;

double clamped(double robustness) {
  return std::min(std::max(robustness, -kMostRobustness), kMostRobustness);
}

double scale_of(const Node& node) {
  if (node.operation == Operation::kField) {
    return fields()[static_cast<std::size_t>(node.field)].scale;
  }
  double scale = 0.0;
  if (node.left) scale = std::max(scale, scale_of(*node.left));
  if (node.right) scale = std::max(scale, scale_of(*node.right));
  return scale;
}

std::optional<double> number_of(const Node& node, const FieldValues& values) {
  if (node.operation == Operation::kNumber) return node.number;
  if (node.operation == Operation::kField) return values[node.field];
  const auto left = number_of(*node.left, values);
  if (!left) return std::nullopt;
  if (node.operation == Operation::kMinus) return -*left;
  const auto right = number_of(*node.right, values);
  if (!right) return std::nullopt;
  double result = 0.0;
  switch (node.operation) {
    case Operation::kAdd:
      result = *left + *right;
      break;
    case Operation::kSubtract:
      result = *left - *right;
      break;
    case Operation::kMultiply:
      result = *left * *right;
      break;
    default:
      if (*right == 0.0) return std::nullopt;
      result = *left / *right;
  }
  if (std::isnan(result)) return std::nullopt;  // of what is endless
  return result;
}

/// How near a run that arrived was to not arriving: late, or after a long way round.
double room_of_arrival(const FieldValues& values) {
  double room = values[Field::kTimeLeft].value_or(1.0);
  const auto& ratio = values[Field::kPathRatio];
  if (ratio && *ratio > 0.0) room = std::min(room, 1.0 / *ratio);
  return room;
}

double room_of_clearance(const FieldValues& values) {
  const double scale_m = fields()[static_cast<std::size_t>(Field::kClearance_m)].scale;
  return std::min(1.0, values[Field::kClearance_m].value_or(scale_m) / scale_m);
}

bool is_outcome(const FieldValues& values, const char* word) {
  return values.word(Field::kOutcome) == word;
}

/// The robustness of an equality of words that holds or not.
double word_robustness(const Node& node, bool holds, const FieldValues& values) {
  if (!holds) return -1.0;
  if (node.left->field != Field::kOutcome) return 1.0;
  const auto& words = fields()[static_cast<std::size_t>(Field::kOutcome)].words;
  const std::string& word = words[static_cast<std::size_t>(node.right->number)];
  const bool is_equality = node.operation == Operation::kEqual;
  if (is_equality && word == "reached") return room_of_arrival(values);
  if (!is_equality && word == "collided") return room_of_clearance(values);
  if (!is_equality && word == "timeout") return values[Field::kTimeLeft].value_or(1.0);
  return 1.0;
}

bool is_of_words(const Node& node) {
  return node.left->operation == Operation::kField &&
         fields()[static_cast<std::size_t>(node.left->field)].type == FieldType::kWord;
}

bool holds(Operation operation, double left, double right) {
  switch (operation) {
    case Operation::kEqual:
      return left == right;
    case Operation::kUnequal:
      return left != right;
    case Operation::kLess:
      return left < right;
    case Operation::kAtMost:
      return left <= right;
    case Operation::kGreater:
      return left > right;
    default:
      return left >= right;
  }
}

Verdict compare(const Node& node, const FieldValues& values) {
  const auto left = number_of(*node.left, values);
  const auto right = number_of(*node.right, values);
  if (!left || !right) return {};
  const bool is_true = holds(node.operation, *left, *right);
  if (is_of_words(node)) return {is_true, word_robustness(node, is_true, values)};
  const double scale = std::max(scale_of(*node.left), scale_of(*node.right));
  // Two endless values differ by nothing.
  const double difference = *left == *right ? 0.0 : *right - *left;
  const double distance = clamped(difference / (scale > 0.0 ? scale : 1.0));
  switch (node.operation) {
    case Operation::kEqual:
      return {is_true, is_true ? 1.0 : -std::fabs(distance)};
    case Operation::kUnequal:
      return {is_true, is_true ? std::fabs(distance) : -1.0};
    case Operation::kLess:
    case Operation::kAtMost:
      return {is_true, distance};
    default:
      return {is_true, -distance};
  }
}

Verdict flag(Field field, const FieldValues& values) {
  const auto& value = values[field];
  if (!value) return {};
  const bool is_true = *value != 0.0;
  if (!is_true) return {false, -1.0};
  const bool arrived = field == Field::kSuccess && is_outcome(values, "reached");
  return {true, arrived ? room_of_arrival(values) : 1.0};
}

/// `decisive`: the value of one side that decides whatever the other is.
Verdict join(const Verdict& left, const Verdict& right, bool decisive) {
  const auto is = [](const Verdict& verdict, bool value) { return verdict.holds == value; };
  const auto more_extreme = [decisive](double a, double b) {
    return decisive ? std::max(a, b) : std::min(a, b);
  };
  if (left.holds && right.holds) {
    const bool result = is(left, decisive) || is(right, decisive) ? decisive : !decisive;
    return {result, more_extreme(*left.robustness, *right.robustness)};
  }
  if (is(left, decisive)) return left;
  if (is(right, decisive)) return right;
  return {};
}

Verdict judge_node(const Node& node, const FieldValues& values) {
  switch (node.operation) {
    case Operation::kField:
      return flag(node.field, values);
    case Operation::kNot: {
      const Verdict inside = judge_node(*node.left, values);
      if (!inside.holds) return {};
      return {!*inside.holds, -*inside.robustness};
    }
    case Operation::kAnd:
      return join(judge_node(*node.left, values), judge_node(*node.right, values), false);
    case Operation::kOr:
      return join(judge_node(*node.left, values), judge_node(*node.right, values), true);
    default:
      return compare(node, values);
  }
}

bool names(const Node& node, Field field) {
  if (node.operation == Operation::kField && node.field == field) return true;
  return (node.left && names(*node.left, field)) || (node.right && names(*node.right, field));
}

}  // namespace

Verdict Property::judge(const FieldValues& values) const { return judge_node(*root_, values); }

bool Property::uses(Field field) const { return names(*root_, field); }

}  // namespace clew::hunt
