// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "hunt/property.hpp"

namespace clew::hunt {

enum class Operation {
  kNumber,
  kField,
  kMinus,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kEqual,
  kUnequal,
  kLess,
  kAtMost,
  kGreater,
  kAtLeast,
  kNot,
  kAnd,
  kOr
};

/// A property as a tree. What a node means follows from its operation; the parser has checked the
/// types, so a comparison has numbers under it and a conjunction has statements.
struct Property::Node {
  Operation operation = Operation::kNumber;
  double number = 0.0;            ///< of kNumber
  Field field = Field::kOutcome;  ///< of kField
  std::shared_ptr<const Node> left;
  std::shared_ptr<const Node> right;
};

}  // namespace clew::hunt
