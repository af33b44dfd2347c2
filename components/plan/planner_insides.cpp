// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "domain/words.hpp"
#include "map/lattice.hpp"
#include "plan/astar_planner.hpp"
#include "plan/neural_map_planner.hpp"
#include "plan/world_subgoals.hpp"

namespace clew::plan {
namespace {

// What is told of the landscape: as many neurons on each side of the robot.
constexpr std::int32_t kReach = 32;
// What is drawn of it: all, in as many blocks a side at most.
constexpr std::int32_t kMostBlocks = 64;
// In a larger map only what is not farther from the target than the robot: all of it takes long.
constexpr std::size_t kMostWhole = 256 * 256;

const char* say_room(map::Clearance room) {
  switch (room) {
    case map::Clearance::kNone:
      return "no room";
    case map::Clearance::kTouching:
      return "less room than the body needs, as far as is believed";
    case map::Clearance::kSuspected:
      return "room only if suspected obstacles are none";
    case map::Clearance::kNarrow:
      return "just enough room";
    case map::Clearance::kOpen:
      return "room to spare";
  }
  return "unknown room";
}

double length_of(const std::vector<core::Vec2>& path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += core::length(path[i] - path[i - 1]);
  return length_m;
}

}  // namespace

void WorldSubgoals::tell(const Situation& situation, domain::Inside& inside) const {
  const std::size_t count = situation.subgoals.size();
  inside.values.number("next_subgoal", state_.next);
  inside.values.number("subgoals", static_cast<double>(count));
  inside.picture.layers.push_back(
      {"the world's subgoals", domain::PictureLayer::Kind::kPoints, {}, situation.subgoals});
  inside.say(state_.next < count
                 ? "It is on the way to subgoal " + std::to_string(state_.next + 1) + " of the " +
                       std::to_string(count) + " that the world gives."
                 : "All subgoals that the world gives are reached.");
}

void AStarPlanner::tell(const Situation& situation, domain::Inside& inside) const {
  const auto age = static_cast<double>(situation.odometry.stamp.tick - state_.planned_tick);
  inside.values.flag("path_exists", !state_.path.empty());
  inside.values.number("path_age", age * tick_s_, "s");
  inside.values.number("path_length", length_of(state_.path), "m");
  inside.values.number("path_corners", static_cast<double>(state_.path.size()));
  inside.values.number("piece", state_.piece);
  inside.values.number("closed_places", static_cast<double>(state_.closed.size()));
  inside.picture.layers.push_back(
      {"path of least cost", domain::PictureLayer::Kind::kWay, {}, state_.path});
  inside.say(state_.path.empty()
                 ? "The map shows no path to the target."
                 : "The path was made " + domain::say_seconds(age * tick_s_) + " ago and is " +
                       domain::say_metres(length_of(state_.path)) + " long.");
}

void NeuralMapPlanner::tell(const Situation& situation, domain::Inside& inside) const {
  const core::Vec2 robot = situation.odometry.pose_odom_robot.position();
  const auto age = static_cast<double>(situation.odometry.stamp.tick - state_.planned_tick);
  const double length_m = length_of(state_.path);
  inside.values.flag("path_exists", !state_.path.empty());
  inside.values.number("path_age", age * tick_s_, "s");
  inside.values.number("path_length", length_m, "m");
  inside.values.text("room_on_path", say_room(state_.room));
  inside.values.number("path_points", static_cast<double>(state_.path.size()));
  inside.values.number("subgoal_index", state_.subgoal);
  inside.values.flag("astray", state_.astray);
  // The landscape is no state: that of now is evolved anew, in a copy.
  NeuralMapPlanner now = *this;
  now.plan(situation);
  now.tell_landscape(robot, inside);
  // The path needs no activation beyond the robot's.
  if (now.units_.size() <= kMostWhole) {
    now.landscape_.evolve(now.units_, now.passable_, now.target_units(situation));
  }
  now.draw_landscape(inside.picture);
  if (state_.path.empty()) {
    inside.say("Activation does not reach the robot, so no path is known.");
    return;
  }
  inside.say("The path was made " + domain::say_seconds(age * tick_s_) + " ago, is " +
             domain::say_metres(length_m) + " long and has " + say_room(state_.room) + ".");
  if (state_.astray) inside.say("No straight line leads to the subgoal any more.");
  inside.picture.layers.push_back(
      {"path of steepest ascent", domain::PictureLayer::Kind::kWay, {}, state_.path});
}

/// The logarithm of the activation around the robot.
void NeuralMapPlanner::tell_landscape(const core::Vec2& robot, domain::Inside& inside) const {
  const auto centre = nearest_unit(robot);
  if (!centre) return;
  double least = 0.0;
  domain::InsideGrid activation{
      2 * kReach + 1, {}, "neuron, along x", "neuron, y from the top", {}};
  for (std::int32_t row = centre->row + kReach; row >= centre->row - kReach; --row) {
    for (std::int32_t column = centre->column - kReach; column <= centre->column + kReach;
         ++column) {
      const double log = landscape_.log_activation({column, row});
      if (std::isfinite(log)) least = std::min(least, log);
      activation.values.push_back(log);
    }
  }
  // What is not active is drawn as the palest.
  for (double& value : activation.values) {
    if (!std::isfinite(value)) value = least - 1.0;
  }
  activation.marked = activation.values.size() / 2;
  inside.values.grid("log_activation", std::move(activation));
}

/// The whole landscape, as the paper's figure 2 has it. A block of neurons is as bright as the most
/// active of them; what is not active is not drawn.
void NeuralMapPlanner::draw_landscape(domain::Picture& picture) const {
  const std::int32_t across = std::max(units_.columns, units_.rows);
  const std::int32_t side = std::max(1, (across + kMostBlocks - 1) / kMostBlocks);
  const core::Vec2 cell_m = units_.cell_m * core::Vec2(1.0, map::row_distance(parameters_.lattice));
  domain::PictureLayer activation{
      "activation of the map", domain::PictureLayer::Kind::kValues, {}, {}};
  double least = std::numeric_limits<double>::max();
  double most = std::numeric_limits<double>::lowest();
  for (std::int32_t row = 0; row * side < units_.rows; ++row) {
    for (std::int32_t column = 0; column * side < units_.columns; ++column) {
      const map::Cell first{column * side, row * side};
      const double log = most_active_of(first, side);
      if (!std::isfinite(log)) continue;
      least = std::min(least, log);
      most = std::max(most, log);
      // Blocks at the rim end with the map.
      const core::Vec2 cells(std::min(side, units_.columns - first.column),
                             std::min(side, units_.rows - first.row));
      const core::Vec2 from = map::centre(parameters_.lattice, units_, first) - 0.5 * cell_m;
      const core::Vec2 to = from + cells.cwiseProduct(cell_m);
      activation.cells.push_back(
          {{from, core::Vec2(to.x(), from.y()), to, core::Vec2(from.x(), to.y())}, log});
    }
  }
  for (domain::PictureCell& cell : activation.cells) {
    cell.value = most > least ? (cell.value - least) / (most - least) : 1.0;
  }
  if (!activation.cells.empty()) picture.layers.push_back(std::move(activation));
}

/// The logarithm of the greatest activation in a block that begins with this cell; infinitely
/// little if nothing there is active.
double NeuralMapPlanner::most_active_of(const map::Cell& first, std::int32_t side) const {
  double most = -std::numeric_limits<double>::infinity();
  for (std::int32_t row = first.row; row < std::min(first.row + side, units_.rows); ++row) {
    for (std::int32_t column = first.column; column < std::min(first.column + side, units_.columns);
         ++column) {
      const double log = landscape_.log_activation({column, row});
      if (std::isfinite(log)) most = std::max(most, log);
    }
  }
  return most;
}

}  // namespace clew::plan
