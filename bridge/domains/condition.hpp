// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "domains/sample_fields.hpp"

namespace clew::domains {

/// A condition on a sample: `pose.x_m > 2.5`, `outcome != OUTCOME_RUNNING`, `blocked == true`.
struct Condition {
  enum class Operator { kEqual, kUnequal, kLess, kAtMost, kGreater, kAtLeast };

  std::string text;  ///< as written
  FieldPath field;
  Operator compare = Operator::kEqual;
  std::string value;

  /// Reads `FIELD OPERATOR VALUE`, apart by spaces.
  static core::Result<Condition> parse(const std::string& text);

  /// Whether a message of this type has the field, and the field can be compared like that. True of
  /// nothing that is known of a type whose fields are unknown: refused.
  core::Result<void> check(const std::string& type) const;

  /// Whether it holds; not for an item that a list does not have. The type was checked. Refused:
  /// bytes that are no message of this type.
  core::Result<bool> holds(const std::string& type, std::string_view cdr) const;
};

}  // namespace clew::domains
