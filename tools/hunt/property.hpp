// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "hunt/run_fields.hpp"

namespace clew::hunt {

/// What a property is for a run.
struct Verdict {
  /// None: it depends on a value that the run does not have.
  std::optional<bool> holds;
  /// By how much it holds (positive) or fails (negative), in the scales of its fields; within
  /// [-kMostRobustness, kMostRobustness]. None together with `holds`.
  std::optional<double> robustness;
};

inline constexpr double kMostRobustness = 10.0;

/// A statement about a run, as `outcome == reached and path_ratio < 1.5`. It is a formula over the
/// fields of one run: no names besides them, no loops, no side effects.
///
///     property   = conjunction { "or" conjunction }
///     conjunction = negation { "and" negation }
///     negation   = "not" negation | comparison
///     comparison = sum [ ("==" | "!=" | "<" | "<=" | ">" | ">=") sum ]
///     sum        = product { ("+" | "-") product }
///     product    = factor { ("*" | "/") factor }
///     factor     = number | FIELD | WORD | "-" factor | "(" property ")"
///
/// A FIELD is a name of fields(). A WORD stands only after `==` or `!=` of a field of words, and is
/// one of its words. What is compared are numbers, what is joined are comparisons and flags.
///
/// Truth is three-valued (Kleene 1952): a comparison with a value that is not there, or a division
/// by zero, is unknown; `false and unknown` is false, `true or unknown` true.
///
/// Robustness is that of temporal logic without time (Fainekos & Pappas 2009, "Robustness of
/// temporal logic specifications for continuous-time signals"; Donze & Maler 2010): the signed
/// distance of a comparison from its border, the least of a conjunction, the greatest of a
/// disjunction. *Deviation:* distances are in scales of the fields (FieldInfo::scale, the greatest
/// of a comparison), so that metres and counts can be weighed against each other. An equality that
/// holds has robustness 1. `outcome == reached` and `success`, where the outcome is reached, have
/// the least of time_left and 1 / path_ratio, and `outcome != collided`, where it holds, that of
/// clearance_m: so a near miss is one before it is a failure.
class Property {
 public:
  /// Refused, with the column: what is no formula, unknown fields and words (the error lists those
  /// that are allowed), comparisons of what is no number, more than kMostLength bytes or kDeepest
  /// levels. `source` is named in errors.
  static core::Result<Property> parse(std::string_view text, const std::string& source);

  static constexpr std::size_t kMostLength = 4096;
  static constexpr std::size_t kDeepest = 64;

  Verdict judge(const FieldValues& values) const;
  /// Whether the verdict may depend on this field.
  bool uses(Field field) const;
  const std::string& text() const { return text_; }

  struct Node;

 private:
  Property(std::string text, std::shared_ptr<const Node> root)
      : text_(std::move(text)), root_(std::move(root)) {}

  std::string text_;
  std::shared_ptr<const Node> root_;
};

}  // namespace clew::hunt
