// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/result.hpp"

namespace clew::domains {

/// A truth value, a number, or a text; an enumerator is its name in idl/.
using FieldValue = std::variant<bool, double, std::string>;

/// A place in a message: `stamp.tick`, `ranges_m[3]`, `header.frame_id`, `entries.length`.
struct FieldPath {
  struct Step {
    std::string name;  ///< of a member; empty: an item of a list
    std::size_t index = 0;
  };
  std::vector<Step> steps;

  /// Refused: what is no such path.
  static core::Result<FieldPath> parse(const std::string& text);
};

/// Whether the fields of a DDS type are known: Clew's topics, and the messages of ROS 2 that
/// bridge/ros2 speaks.
bool knows_fields_of(const std::string& type);

/// A value of the kind that stands there; none if the type has no single value at that place.
std::optional<FieldValue> kind_of_field(const std::string& type, const FieldPath& path);

/// The value there; none for an item that a list does not have. Refused: bytes that are no message
/// of this type.
core::Result<std::optional<FieldValue>> read_field(const std::string& type, std::string_view cdr,
                                                   const FieldPath& path);

}  // namespace clew::domains
