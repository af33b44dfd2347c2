// SPDX-License-Identifier: Apache-2.0
#include "world/world_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "world/goal_reader.hpp"

namespace clew::world {

using core::Result;
using core::YamlNode;

namespace {

// Numbers within what a world may span.
Result<void> check_span(const YamlNode& node, const std::vector<double>& numbers,
                        const char* allowed) {
  for (const double number : numbers) {
    if (std::fabs(number) <= kLargest) continue;
    return node.error(fmt::format("{} in {} is beyond +-{}, the largest number allowed", number,
                                  allowed, kLargest));
  }
  return {};
}

}  // namespace

Result<std::vector<double>> read_numbers(const YamlNode& node, std::size_t count,
                                         const char* allowed) {
  auto numbers = node.numbers(count, allowed);
  if (!numbers.ok()) return numbers;
  CLEW_RETURN_IF_ERROR(check_span(node, *numbers, allowed));
  return numbers;
}

Result<void> read(const YamlNode& node, double& positive) {
  const auto number = node.number();
  if (!number.ok()) return number.error();
  if (!(*number > 0.0 && *number <= kLargest)) {
    return node.error(
        fmt::format("found {}, expected a number above 0, at most {}", node.found(), kLargest));
  }
  positive = *number;
  return {};
}

Result<void> read(const YamlNode& node, bool& value) {
  const auto boolean = node.boolean();
  if (!boolean.ok()) return boolean.error();
  value = *boolean;
  return {};
}

Result<void> read(const YamlNode& node, std::string& text) {
  const auto string = node.string();
  if (!string.ok()) return string.error();
  text = *string;
  return {};
}

Result<void> read(const YamlNode& node, Vec2& point) {
  const auto numbers = read_numbers(node, 2, "[x, y]");
  if (!numbers.ok()) return numbers.error();
  point = {(*numbers)[0], (*numbers)[1]};
  return {};
}

Result<void> read(const YamlNode& node, Waypoint& waypoint) {
  const auto goal = read_goal(node);
  if (!goal.ok()) return goal.error();
  CLEW_RETURN_IF_ERROR(check_span(node, {goal->place.x(), goal->place.y()}, kGoalForms));
  waypoint.place = goal->place;
  waypoint.heading = goal->heading;
  if (!goal->radius_m) return {};
  waypoint.radius_m = *goal->radius_m;
  if (waypoint.radius_m > 0.0 && waypoint.radius_m <= kLargest) return {};
  return node.error(fmt::format("the radius is {}; it must be above 0 and at most {}",
                                waypoint.radius_m, kLargest));
}

Result<void> read(const YamlNode& node, GoalHeading& heading) {
  if (node.kind() != core::YamlKind::kList) {
    const auto number = node.number();
    if (!number.ok()) return number.error();
    return set_heading(node, {*number}, heading);
  }
  const auto numbers = node.numbers(2, "heading or [heading, tolerance]");
  if (!numbers.ok()) return numbers.error();
  return set_heading(node, *numbers, heading);
}

Result<void> read(const YamlNode& node, Pose2& pose) {
  const auto numbers = read_numbers(node, 3, "[x, y, heading]");
  if (!numbers.ok()) return numbers.error();
  pose = {(*numbers)[0], (*numbers)[1], core::wrap_angle_rad((*numbers)[2])};
  return {};
}

Result<void> read(const YamlNode& node, World::Segment& wall) {
  const auto numbers = read_numbers(node, 4, "[x1, y1, x2, y2]");
  if (!numbers.ok()) return numbers.error();
  wall = {{(*numbers)[0], (*numbers)[1]}, {(*numbers)[2], (*numbers)[3]}};
  return {};
}

Result<void> read(const YamlNode& node, World::Circle& circle) {
  const auto numbers = read_numbers(node, 3, "[x, y, radius]");
  if (!numbers.ok()) return numbers.error();
  circle = {{(*numbers)[0], (*numbers)[1]}, (*numbers)[2]};
  if (circle.radius_m > 0.0) return {};
  return node.error(fmt::format("the radius is {}; it must be above 0", circle.radius_m));
}

Result<void> read(const YamlNode& node, Polygon& polygon) {
  const auto items = node.items();
  if (!items.ok() || items->size() < 3) {
    return node.error("found " + node.found() + ", expected at least three points [[x, y], ...]");
  }
  for (const YamlNode& item : *items) CLEW_RETURN_IF_ERROR(read(item, polygon.emplace_back()));
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (polygon[i] != polygon[(i + 1) % polygon.size()]) continue;
    return (*items)[i].error(
        "the next point of the polygon is the same; each is given once, and "
        "the last is joined to the first");
  }
  if (const auto crossing = find_crossing(polygon)) {
    const auto [first, second] = std::minmax(crossing->first, crossing->second);
    return (*items)[second].error(fmt::format(
        "the polygon crosses or touches itself: the side that begins here, {}, meets side {} (side "
        "0 begins at the first point)",
        second, first));
  }
  return {};
}

}  // namespace clew::world
