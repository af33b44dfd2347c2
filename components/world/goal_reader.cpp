// SPDX-License-Identifier: Apache-2.0
#include "world/goal_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

#include "core/angle.hpp"

namespace clew::world {
namespace {

using core::Result;
using core::YamlNode;

constexpr double kMostHeading_rad = 2.0 * core::kPi;

}  // namespace

Result<Goal> read_goal(const YamlNode& node, const char* forms) {
  const auto items = node.items();
  if (!items.ok()) return items.error();
  if (items->size() < 2 || items->size() > 5) {
    return node.error("found " + node.found() + ", expected " + forms);
  }
  std::vector<double> numbers;
  const bool has_radius = items->size() > 2 && (*items)[2].kind() != core::YamlKind::kNull;
  for (std::size_t i = 0; i < items->size(); ++i) {
    if (i == 2 && !has_radius) continue;
    const auto number = (*items)[i].number();
    if (!number.ok()) return number.error();
    numbers.push_back(*number);
  }
  Goal goal{{numbers[0], numbers[1]}, std::nullopt, std::nullopt};
  if (has_radius) goal.radius_m = numbers[2];
  if (items->size() > 3) {
    numbers.erase(numbers.begin(), numbers.begin() + (has_radius ? 3 : 2));
    CLEW_RETURN_IF_ERROR(set_heading(node, numbers, goal.heading.emplace()));
  }
  return goal;
}

Result<void> set_heading(const YamlNode& node, const std::vector<double>& numbers,
                         GoalHeading& heading) {
  if (!(std::fabs(numbers[0]) <= kMostHeading_rad)) {
    return node.error(
        fmt::format("the heading is {}; allowed: -2 pi to 2 pi, in radians", numbers[0]));
  }
  heading.heading_rad = core::wrap_angle_rad(numbers[0]);
  if (numbers.size() < 2) return {};
  heading.tolerance_rad = numbers[1];
  if (heading.tolerance_rad > 0.0 && heading.tolerance_rad <= core::kPi) return {};
  return node.error(
      fmt::format("the tolerance of the heading is {}; allowed: above 0 and at most pi, in radians",
                  heading.tolerance_rad));
}

std::string goal_numbers(const Goal& goal, const char* separator) {
  std::string text = fmt::format("{}{}{}", goal.place.x(), separator, goal.place.y());
  if (goal.radius_m) {
    text += fmt::format("{}{}", separator, *goal.radius_m);
  } else if (goal.heading) {
    text += fmt::format("{}~", separator);
  }
  if (!goal.heading) return text;
  return text + fmt::format("{}{}{}{}", separator, goal.heading->heading_rad, separator,
                            goal.heading->tolerance_rad);
}

std::string target_heading_yaml(const std::optional<GoalHeading>& heading) {
  if (!heading) return {};
  return fmt::format("target_heading: [{}, {}]\n", heading->heading_rad, heading->tolerance_rad);
}

}  // namespace clew::world
