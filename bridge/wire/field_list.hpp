// SPDX-License-Identifier: Apache-2.0
/// Messages as lists of named values, so that two of them can be compared field by field.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "domain/topics.hpp"

namespace clew::bridge {

/// A truth value, a whole number, a number, a text, or an enumerator by its name in idl/ (by its
/// number, if it has no name).
using FieldValue = std::variant<bool, std::uint64_t, double, std::string, std::string_view>;

/// Whether two values are the same bits: 0 and -0 are not, a NaN is the same as itself.
bool same_bits(const FieldValue& a, const FieldValue& b);

/// The value for people: values of different bits have different texts, and a number reads back as
/// itself. A text stands in quotes, NaN with its bits.
std::string field_text(const FieldValue& value);

struct Field {
  std::string path;  ///< `stamp.tick`, `ranges_m[3]`, `entries[0].rule`
  FieldValue value;
};

/// All values of a message, in the order of idl/. A list is preceded by its length, as
/// `ranges_m.length`.
std::vector<Field> fields_of(domain::ConstMessagePointer message);
template <typename Message>
std::vector<Field> fields_of(const Message& message) {
  return fields_of(domain::ConstMessagePointer(&message));
}

/// The paths that the fields of a topic's messages can have, in the order of idl/, without indices
/// and lengths: `entries.rule`.
std::vector<std::string> field_names(domain::Topic topic);

/// A field in which two messages differ; one that only one of them has (of a longer list) has no
/// value in the other.
struct FieldDifference {
  std::string path;
  std::optional<FieldValue> a;
  std::optional<FieldValue> b;
};

/// All fields that differ, in the order of idl/. Numbers (no whole ones) count as equal if they are
/// at most `tolerance` apart; with 0 they must be the same bits.
std::vector<FieldDifference> differences(domain::ConstMessagePointer a,
                                         domain::ConstMessagePointer b, double tolerance = 0.0);
template <typename Message>
std::vector<FieldDifference> differences(const Message& a, const Message& b,
                                         double tolerance = 0.0) {
  return differences(domain::ConstMessagePointer(&a), domain::ConstMessagePointer(&b), tolerance);
}

}  // namespace clew::bridge
