// SPDX-License-Identifier: Apache-2.0
#include "plan/neural_map_planner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "map/smooth_path.hpp"

namespace clew::plan {
namespace {

// A robot that stands nearer to obstacles than a path may lead is this many radii from one at most.
constexpr double kWithinBodies = 3.5;
// A target beside a wall or between two is narrow as far as this from it.
constexpr double kNarrowEnd_m = 0.75;
// The robot is at the mouth of a narrow end, and not beside it.
constexpr double kAtMouth_m = 0.03;

// What is tried in turn: the room that the path has, and whether its end may be narrow.
struct Attempt {
  map::Clearance least;
  bool narrow_end;
};
constexpr Attempt kAttempts[] = {{map::Clearance::kOpen, false},
                                 {map::Clearance::kOpen, true},
                                 {map::Clearance::kNarrow, false},
                                 {map::Clearance::kSuspected, false},
                                 {map::Clearance::kTouching, false}};

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
    return core::Error{"plan.neural_map: " + landscape.error().message};
  }
  return std::unique_ptr<NeuralMapPlanner>(
      new NeuralMapPlanner(parameters, std::move(landscape).value(), setup));
}

Subgoal NeuralMapPlanner::step(const Situation& situation) {
  const core::Vec2 robot = situation.odometry.pose_odom_robot.position();
  const bool has_new_target = state_.target != situation.target;
  if (!state_.planned || has_new_target || is_old(situation)) plan(situation);
  if (!state_.path.empty()) {
    const double left_m = core::length(state_.path[state_.subgoal] - robot);
    // How near is enough takes two looks along a line.
    if (left_m <= parameters_.arrive_m && left_m <= near_enough_m(situation)) {
      choose_subgoal(situation);
    }
    notice_astray(situation);
  }
  const bool is_last = state_.subgoal + 1 >= state_.path.size();
  if (is_last || comes_in(situation)) return {situation.target, situation.target_radius_m};
  return {state_.path[state_.subgoal], parameters_.arrive_m};
}

/// Whether the target is near and the way to it free, whatever cells tell of it.
bool NeuralMapPlanner::comes_in(const Situation& situation) const {
  const core::Vec2 robot = situation.odometry.pose_odom_robot.position();
  return core::length(situation.target - robot) <= parameters_.come_in_m &&
         situation.map.leads_straight(robot, situation.target);
}

/// Whether the end of the path is narrow, and the target straight ahead from this point of it.
bool NeuralMapPlanner::is_mouth(const Situation& situation, std::uint32_t point) const {
  const core::Vec2& place = state_.path[point];
  return point + 1 < state_.path.size() &&
         core::length(situation.target - place) <= parameters_.come_in_m &&
         situation.map.leads_straight(place, situation.target) &&
         !situation.map.line_of_sight(place, situation.target, state_.room);
}

double NeuralMapPlanner::near_enough_m(const Situation& situation) const {
  return is_mouth(situation, state_.subgoal) ? kAtMouth_m : parameters_.arrive_m;
}

bool NeuralMapPlanner::is_old(const Situation& situation) const {
  if (!situation.map.changes()) return false;
  const auto age = static_cast<double>(situation.odometry.stamp.tick - state_.planned_tick);
  return (age + 0.5) * tick_s_ >= parameters_.refresh_s;
}

/// Makes the path anew. It stays empty if there is none.
void NeuralMapPlanner::plan(const Situation& situation) {
  state_.planned = true;
  state_.planned_tick = situation.odometry.stamp.tick;
  state_.target = situation.target;
  state_.astray = false;
  state_.path.clear();
  state_.subgoal = 0;
  const RoomView view =
      situation.map.read(situation.odometry.pose_odom_robot.position(), situation.target);
  std::size_t tried_units = 0;
  for (const Attempt& attempt : kAttempts) {
    const bool narrow_end = attempt.narrow_end && parameters_.come_in_m > 0.0;
    const double narrow_m = narrow_end ? kNarrowEnd_m : 0.0;
    const std::size_t units = find_passable(view, attempt.least, situation.target, narrow_m);
    if (units == tried_units) continue;
    tried_units = units;
    if (!make_path(situation)) continue;
    state_.room = attempt.least;
    choose_subgoal(situation);
    return;
  }
}

/// Makes the path over passable_, from the unit nearest to the robot. False if there is none.
bool NeuralMapPlanner::make_path(const Situation& situation) {
  const auto start = nearest_unit(situation.odometry.pose_odom_robot.position());
  if (!start.has_value()) return false;
  landscape_.evolve(units_, passable_, target_units(situation), start);
  if (parameters_.smooth) {
    if (!map::smooth_path(landscape_, *start, state_.path)) return false;
  } else {
    if (!landscape_.path(*start, cells_)) return false;
    for (const map::Cell& cell : cells_) {
      state_.path.push_back(map::centre(parameters_.lattice, units_, cell));
    }
  }
  state_.path.push_back(situation.target);
  return true;
}

/// Makes passable_ tell which units have at least this room, narrow ones being enough this near to
/// the target, and counts them.
std::size_t NeuralMapPlanner::find_passable(const RoomView& view, map::Clearance least,
                                            const core::Vec2& target, double narrow_m) {
  units_ = map::laid_out(parameters_.lattice, view.grid);
  passable_.resize(units_.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < passable_.size(); ++i) {
    // The last unit of a shifted row has its middle on the border of the map.
    const core::Vec2 middle = map::centre(parameters_.lattice, units_, units_.cell(i));
    const auto cell = view.grid.cell_at(middle);
    const bool near = core::length(middle - target) < narrow_m;
    const map::Clearance enough = near ? std::min(least, map::Clearance::kNarrow) : least;
    passable_[i] = cell.has_value() && view.room[view.grid.index(*cell)] >= enough ? 1 : 0;
    count += passable_[i];
  }
  return count;
}

/// All units where the mission is done; if cells are too coarse for one, those from which the
/// target is straight ahead, or at last the one nearest to it.
std::vector<map::Cell> NeuralMapPlanner::target_units(const Situation& situation) const {
  std::vector<map::Cell> cells;
  visit_around(parameters_.lattice, units_, situation.target, situation.target_radius_m,
               [&](const map::Cell& cell, double distance_m) {
                 if (distance_m <= situation.target_radius_m) cells.push_back(cell);
               });
  const bool found = std::any_of(cells.begin(), cells.end(), [&](const map::Cell& cell) {
    return passable_[units_.index(cell)] != 0;
  });
  if (!found && parameters_.come_in_m > 0.0) {
    cells.clear();
    visit_around(parameters_.lattice, units_, situation.target, parameters_.come_in_m,
                 [&](const map::Cell& cell, double distance_m) {
                   if (distance_m > parameters_.come_in_m) return;
                   if (passable_[units_.index(cell)] == 0) return;
                   const core::Vec2 place = map::centre(parameters_.lattice, units_, cell);
                   if (situation.map.leads_straight(place, situation.target)) cells.push_back(cell);
                 });
  }
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
  double nearest_m = kWithinBodies * radius_m_ + units_.cell_m;
  visit_around(parameters_.lattice, units_, place, nearest_m,
               [&](const map::Cell& cell, double distance_m) {
                 if (passable_[units_.index(cell)] == 0) return;
                 if (!(distance_m < nearest_m)) return;
                 nearest = cell;
                 nearest_m = distance_m;
               });
  return nearest;
}

/// The farthest point of the path, from the subgoal on, that a straight line leads to; if there is
/// none, the next that the robot is not at yet. No farther than the mouth of a narrow end.
void NeuralMapPlanner::choose_subgoal(const Situation& situation) {
  const core::Vec2 robot = situation.odometry.pose_odom_robot.position();
  const auto distance_m = [&](std::uint32_t i) { return core::length(state_.path[i] - robot); };
  const auto last = static_cast<std::uint32_t>(state_.path.size()) - 1;
  std::uint32_t next = std::min(state_.subgoal + 1, last);
  while (next < last && distance_m(next) <= parameters_.arrive_m) ++next;
  for (std::uint32_t i = last; i > next; --i) {
    if (distance_m(i) > parameters_.look_ahead_m) continue;
    if (situation.map.line_of_sight(robot, state_.path[i], state_.room)) {
      next = i;
      break;
    }
  }
  for (std::uint32_t i = std::min(state_.subgoal + 1, last); i < last; ++i) {
    if (!is_mouth(situation, i)) continue;
    const bool straight = distance_m(i) <= parameters_.look_ahead_m &&
                          situation.map.leads_straight(robot, state_.path[i]);
    if (next > i || straight) next = i;
    break;
  }
  state_.subgoal = next;
}

void NeuralMapPlanner::notice_astray(const Situation& situation) {
  const core::Vec2 robot = situation.odometry.pose_odom_robot.position();
  if (situation.map.line_of_sight(robot, state_.path[state_.subgoal], state_.room)) {
    state_.astray = false;
    return;
  }
  const std::uint64_t tick = situation.odometry.stamp.tick;
  if (!state_.astray) state_.astray_since = tick;
  state_.astray = true;
  const double astray_s = static_cast<double>(tick - state_.astray_since) * tick_s_;
  if (astray_s >= parameters_.replan_s) plan(situation);
}

void NeuralMapPlanner::save(core::StateWriter& writer) const { writer(state_); }

void NeuralMapPlanner::load(core::StateReader& reader) {
  reader(state_);
  const bool on_path =
      state_.path.empty() ? state_.subgoal == 0 : state_.subgoal < state_.path.size();
  const bool valid = on_path && state_.room <= map::Clearance::kOpen;
  if (!reader.check(valid, "the path has no such subgoal")) state_ = {};
}

}  // namespace clew::plan
