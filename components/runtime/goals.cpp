// SPDX-License-Identifier: Apache-2.0
#include "runtime/goals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "world/goal_reader.hpp"

namespace clew::runtime {
namespace {

using core::Error;
using core::Result;
using core::YamlKind;
using core::YamlNode;
using world::Goal;
using world::Goals;

constexpr char kNoGoal[] = "none";

std::string too_many(std::size_t count) {
  return fmt::format("found {} way-points; allowed: {}", count, world::kMostGoals);
}

std::string list_text(const Goal& goal) { return '[' + world::goal_numbers(goal, ", ") + ']'; }

Result<Goal> parse_place(const std::string& text) {
  const auto list = YamlNode::parse('[' + text + ']', "goal");
  if (!list.ok()) return list.error();
  return world::read_goal(*list, "goal=X,Y[,RADIUS[,HEADING[,TOLERANCE]]]");
}

Result<Goals> read_goals_of_key(const YamlNode& node) {
  if (node.kind() == YamlKind::kScalar) {
    const auto word = node.string();
    if (word.ok() && *word == kNoGoal) return Goals{};
    return node.error("found " + node.found() + ", expected " + world::kGoalForms + ", or none");
  }
  const auto goal = world::read_goal(node);
  if (!goal.ok()) return goal.error();
  return Goals{*goal};
}

Result<Goals> read_waypoints(const YamlNode& node) {
  const auto items = node.items();
  if (!items.ok()) return items.error();
  if (items->empty())
    return node.error("found no way-point, expected [[x, y], [x, y, radius], ...]");
  if (items->size() > world::kMostGoals) return node.error(too_many(items->size()));
  Goals goals;
  for (const YamlNode& item : *items) {
    const auto goal = world::read_goal(item);
    if (!goal.ok()) return goal.error();
    goals.push_back(*goal);
  }
  return goals;
}

}  // namespace

Result<std::optional<GraphGoals>> read_goals(const YamlNode& graph) {
  const auto goal = graph.find("goal");
  const auto mission = graph.find("mission");
  const bool has_waypoints = mission && mission->kind() == YamlKind::kList;
  if (!goal && !has_waypoints) return std::optional<GraphGoals>();
  if (goal && has_waypoints) {
    return mission->error("found way-points beside a goal; allowed: one of the two");
  }
  auto goals = goal ? read_goals_of_key(*goal) : read_waypoints(*mission);
  if (!goals.ok()) return goals.error();
  return std::optional(GraphGoals{std::move(goals).value(), goal ? *goal : *mission});
}

Result<Goals> parse_goals(const std::string& text) {
  if (text == kNoGoal) return Goals{};
  Goals goals;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('/', begin), text.size());
    const std::string place = text.substr(begin, end - begin);
    const auto goal = parse_place(place);
    if (!goal.ok()) {
      const std::string where = goals.empty() && end == text.size()
                                    ? "'goal=" + text + "'"
                                    : fmt::format("way-point {}, '{}'", goals.size() + 1, place);
      return Error{where + ": " + goal.error().message};
    }
    if (goals.size() == world::kMostGoals) return Error{too_many(goals.size() + 1)};
    goals.push_back(*goal);
    begin = end + 1;
  }
  return goals;
}

std::string goals_change(const Goals& goals) {
  std::string text;
  for (const Goal& goal : goals) {
    text += (text.empty() ? "" : "/") + world::goal_numbers(goal, ",");
  }
  return kGoalChange + (goals.empty() ? kNoGoal : text);
}

std::string goals_yaml(const std::optional<Goals>& goals) {
  if (!goals) return {};
  if (goals->empty()) return fmt::format("goal: {}\n", kNoGoal);
  if (goals->size() == 1) return "goal: " + list_text(goals->front()) + '\n';
  std::string text;
  for (const Goal& goal : *goals) text += (text.empty() ? "" : ", ") + list_text(goal);
  return "mission: [" + text + "]\n";
}

}  // namespace clew::runtime
