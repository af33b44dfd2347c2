// SPDX-License-Identifier: Apache-2.0
#include "plan/neural_map_planner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "map/straight_way.hpp"

namespace clew::plan {
namespace {

// The cells around a place, all within `reach_m` and some more, and their distances from it.
template <typename Visit>
void visit_around(map::Lattice lattice, const map::Grid& grid, const core::Vec2& place,
                  double reach_m, Visit visit) {
  const core::Vec2 steps = (place - grid.corner) / grid.cell_m;
  const double row_distance = map::row_distance(lattice);
  const auto reach = static_cast<std::int32_t>(std::ceil(reach_m / grid.cell_m / row_distance)) + 1;
  const auto column = static_cast<std::int32_t>(std::floor(steps.x()));
  const auto row = static_cast<std::int32_t>(std::floor(steps.y() / row_distance));
  for (std::int32_t r = row - reach; r <= row + reach; ++r) {
    for (std::int32_t c = column - reach; c <= column + reach; ++c) {
      const map::Cell cell{c, r};
      if (!grid.contains(cell)) continue;
      visit(cell, core::length(map::centre(lattice, grid, cell) - place));
    }
  }
}

}  // namespace

core::Result<std::unique_ptr<NeuralMapPlanner>> NeuralMapPlanner::create(
    const Parameters& parameters, const domain::BehaviourSetup& setup) {
  auto landscape = map::NeuralMap::create({parameters.lattice, parameters.gain});
  if (!landscape.ok()) {
    return core::Error{"plan.neural_map: " + landscape.error().message, {}, 0, 0};
  }
  return std::unique_ptr<NeuralMapPlanner>(
      new NeuralMapPlanner(parameters, std::move(landscape).value(), setup));
}

Subgoal NeuralMapPlanner::step(const Situation& situation) {
  const core::Vec2 robot = situation.odometry.pose_odom_robot.position();
  if (!state_.planned) plan(situation);
  if (!state_.path.empty()) {
    if (core::length(state_.path[state_.subgoal] - robot) <= parameters_.arrive_m) {
      choose_subgoal(robot);
    }
    notice_astray(situation);
  }
  const bool is_last = state_.subgoal + 1 >= state_.path.size();
  if (is_last) return {situation.target, situation.target_radius_m};
  return {state_.path[state_.subgoal], parameters_.arrive_m};
}

/// Makes the path anew. It stays empty if there is none.
void NeuralMapPlanner::plan(const Situation& situation) {
  state_.planned = true;
  state_.astray = false;
  state_.path.clear();
  state_.subgoal = 0;
  if (!plan_with_room(situation, radius_m_ + parameters_.margin_m) &&
      !plan_with_room(situation, radius_m_)) {
    return;
  }
  choose_subgoal(situation.odometry.pose_odom_robot.position());
}

bool NeuralMapPlanner::plan_with_room(const Situation& situation, double room_m) {
  find_room(situation.map, room_m);
  const auto start = nearest_unit(situation.odometry.pose_odom_robot.position());
  if (!start.has_value()) return false;
  landscape_.evolve(units_, units_passable_, target_units(situation), start);
  std::vector<map::Cell> cells;
  if (!landscape_.path(*start, cells)) return false;
  state_.room_m = room_m;
  for (const map::Cell& cell : cells)
    state_.path.push_back(map::centre(parameters_.lattice, units_, cell));
  state_.path.push_back(situation.target);
  return true;
}

/// Makes passable_ tell where there is so much room.
void NeuralMapPlanner::find_room(const MapSource& source, double room_m) {
  if (map_.room_m.empty()) map_ = source.read(radius_m_ + parameters_.margin_m);
  if (passable_room_m_ == room_m) return;
  map_.passable(room_m, passable_);
  passable_room_m_ = room_m;
  units_ = map::laid_out(parameters_.lattice, map_.grid);
  units_passable_.resize(units_.size());
  for (std::size_t i = 0; i < units_passable_.size(); ++i) {
    // The last unit of a shifted row has its middle on the border of the map.
    const core::Vec2 middle = map::centre(parameters_.lattice, units_, units_.cell(i));
    const auto cell = map_.grid.cell_at(middle);
    units_passable_[i] = cell.has_value() ? passable_[map_.grid.index(*cell)] : 0;
  }
}

/// All units where the mission is done, or the one nearest to its target if cells are too coarse.
std::vector<map::Cell> NeuralMapPlanner::target_units(const Situation& situation) const {
  std::vector<map::Cell> cells;
  visit_around(parameters_.lattice, units_, situation.target, situation.target_radius_m,
               [&](const map::Cell& cell, double distance_m) {
                 if (distance_m <= situation.target_radius_m) cells.push_back(cell);
               });
  if (cells.empty()) {
    const auto nearest = nearest_unit(situation.target);
    if (nearest.has_value()) cells.push_back(*nearest);
  }
  return cells;
}

/// The nearest passable unit, within the robot's own size and a cell: it may stand nearer to an
/// obstacle than a path would lead it.
std::optional<map::Cell> NeuralMapPlanner::nearest_unit(const core::Vec2& place) const {
  std::optional<map::Cell> nearest;
  double nearest_m = 2.0 * (radius_m_ + parameters_.margin_m) + units_.cell_m;
  visit_around(parameters_.lattice, units_, place, nearest_m,
               [&](const map::Cell& cell, double distance_m) {
                 if (units_passable_[units_.index(cell)] == 0) return;
                 if (!(distance_m < nearest_m)) return;
                 nearest = cell;
                 nearest_m = distance_m;
               });
  return nearest;
}

/// The farthest point of the path, from the subgoal on, that a straight line leads to; the next
/// point if there is none.
void NeuralMapPlanner::choose_subgoal(const core::Vec2& robot) {
  const auto last = static_cast<std::uint32_t>(state_.path.size()) - 1;
  const std::uint32_t next = std::min(state_.subgoal + 1, last);
  for (std::uint32_t i = last; i > next; --i) {
    if (core::length(state_.path[i] - robot) > parameters_.look_ahead_m) continue;
    if (map::straight_way(map_.grid, passable_, robot, state_.path[i])) {
      state_.subgoal = i;
      return;
    }
  }
  state_.subgoal = next;
}

void NeuralMapPlanner::notice_astray(const Situation& situation) {
  find_room(situation.map, state_.room_m);
  const core::Vec2 robot = situation.odometry.pose_odom_robot.position();
  if (map::straight_way(map_.grid, passable_, robot, state_.path[state_.subgoal])) {
    state_.astray = false;
    return;
  }
  const std::uint64_t tick = situation.odometry.stamp.tick;
  if (!state_.astray) state_.astray_since = tick;
  state_.astray = true;
  const double astray_s = static_cast<double>(tick - state_.astray_since) * tick_s_;
  if (astray_s >= parameters_.replan_s) plan(situation);
}

void NeuralMapPlanner::save(core::StateWriter& writer) const {
  State state = state_;
  writer(state);
}

}  // namespace clew::plan
