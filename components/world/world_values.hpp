// SPDX-License-Identifier: Apache-2.0
/// Values of a world file, each with its own checks; errors name the place.
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/yaml_reader.hpp"
#include "world/polygon.hpp"
#include "world/world.hpp"

namespace clew::world {

// Beyond this the last bit of a double comes near the margins of the queries.
inline constexpr double kLargest = 1e5;

/// A list of exactly `count` numbers within what a world may span; `allowed` says of what.
core::Result<std::vector<double>> read_numbers(const core::YamlNode& node, std::size_t count,
                                               const char* allowed);

core::Result<void> read(const core::YamlNode& node, double& positive);
core::Result<void> read(const core::YamlNode& node, bool& value);
core::Result<void> read(const core::YamlNode& node, std::string& text);
core::Result<void> read(const core::YamlNode& node, Vec2& point);
/// A radius that is not given is left as it is.
core::Result<void> read(const core::YamlNode& node, Waypoint& waypoint);
/// `heading` or `[heading, tolerance]`.
core::Result<void> read(const core::YamlNode& node, GoalHeading& heading);
core::Result<void> read(const core::YamlNode& node, Pose2& pose);
core::Result<void> read(const core::YamlNode& node, World::Segment& wall);
core::Result<void> read(const core::YamlNode& node, World::Circle& circle);
core::Result<void> read(const core::YamlNode& node, Polygon& polygon);

template <typename T>
core::Result<void> read_required(const core::YamlNode& map, const char* key, T& value) {
  const auto node = map.at(key);
  if (!node.ok()) return node.error();
  return read(*node, value);
}

template <typename T>
core::Result<void> read_optional(const core::YamlNode& map, const char* key, T& value) {
  const auto node = map.find(key);
  return node ? read(*node, value) : core::Result<void>();
}

template <typename T>
core::Result<void> read_list(const core::YamlNode& map, const char* key, std::vector<T>& values) {
  const auto node = map.find(key);
  if (!node) return {};
  const auto items = node->items();
  if (!items.ok()) return items.error();
  values.reserve(items->size());
  for (const core::YamlNode& item : *items) CLEW_RETURN_IF_ERROR(read(item, values.emplace_back()));
  return {};
}

}  // namespace clew::world
