// SPDX-License-Identifier: Apache-2.0
#include "plan/astar_planner.hpp"

#include <algorithm>
#include <cmath>

#include "core/segment.hpp"
#include "domain/held.hpp"
#include "map/tight_path.hpp"

namespace clew::plan {
namespace {

// A path ends this share of the target's radius from it: there, the robot has arrived.
constexpr double kArrivesWithin_ratio = 0.8;
// A robot that has not moved by more than this is held.
constexpr double kHeld_m = 0.12;
// What holds it is this far ahead of its centre, and closes so much around.
constexpr double kAhead_m = 0.05;
constexpr double kClosed_m = 0.06;
constexpr std::size_t kMostClosed = 4096;
// Shares of the distance ahead that are tried until a straight line leads there.
constexpr double kShares[] = {1.0, 0.75, 0.5, 0.25};

}  // namespace

core::Result<std::unique_ptr<AStarPlanner>> AStarPlanner::create(
    const Parameters& parameters, const domain::BehaviourSetup& setup) {
  if (parameters.least_look_ahead_m > parameters.most_look_ahead_m) {
    return core::Error{"plan.astar: least_look_ahead_m must not be greater than most_look_ahead_m"};
  }
  return std::make_unique<AStarPlanner>(parameters, setup);
}

AStarPlanner::AStarPlanner(const Parameters& parameters, const domain::BehaviourSetup& setup)
    : parameters_(parameters),
      tick_s_(setup.tick_s),
      held_ticks_(domain::held_ticks(parameters.held_s, kHeld_m, setup)) {}

Subgoal AStarPlanner::step(const Situation& situation) {
  const core::Vec2 robot = situation.odometry.pose_odom_robot.position();
  note_where_held(situation);
  if (!state_.planned || is_old(situation) || is_cut(situation, robot)) plan(situation);
  if (state_.path.empty()) return {situation.target, situation.target_radius_m};
  return pursued(situation, robot);
}

/// A robot that stays where it is cannot go where the path leads.
void AStarPlanner::note_where_held(const Situation& situation) {
  const core::Vec2 robot = situation.odometry.pose_odom_robot.position();
  const std::uint64_t tick = situation.odometry.stamp.tick;
  if (!state_.planned || core::length(robot - state_.held) > kHeld_m) {
    state_.held = robot;
    state_.held_tick = tick;
  }
  if (tick - state_.held_tick < held_ticks_) return;
  state_.held_tick = tick;
  if (state_.path.empty() || state_.closed.size() >= kMostClosed) return;
  const core::Vec2 way = ahead(pass(robot) + parameters_.least_look_ahead_m).place - robot;
  const double way_m = core::length(way);
  if (way_m == 0.0) return;
  state_.closed.emplace_back(robot + std::min(way_m, kAhead_m) / way_m * way);
  state_.planned = false;
}

bool AStarPlanner::is_old(const Situation& situation) const {
  if (situation.target != state_.target) return true;  // a new goal
  if (!situation.map.changes()) return false;
  const auto age = static_cast<double>(situation.odometry.stamp.tick - state_.planned_tick);
  return (age + 0.5) * tick_s_ >= parameters_.replan_s;
}

/// Whether no straight line leads to the next corner any more.
bool AStarPlanner::is_cut(const Situation& situation, const core::Vec2& robot) const {
  if (state_.path.empty()) return false;
  const std::size_t next = std::min<std::size_t>(state_.piece + 1, state_.path.size() - 1);
  return !situation.map.line_of_sight(robot, state_.path[next], map::Clearance::kSuspected);
}

/// Makes the path anew. It stays empty if there is none.
void AStarPlanner::plan(const Situation& situation) {
  const core::Vec2 robot = situation.odometry.pose_odom_robot.position();
  state_.planned = true;
  state_.planned_tick = situation.odometry.stamp.tick;
  state_.target = situation.target;
  state_.piece = 0;
  state_.path.clear();
  if (state_.closed.empty() &&
      situation.map.line_of_sight(robot, situation.target, map::Clearance::kOpen)) {
    state_.path = {robot, situation.target};
    return;
  }
  charge(situation.map.read(robot, situation.target), robot);
  const auto* cells = &search_.find(costs_, robot, situation.target,
                                    kArrivesWithin_ratio * situation.target_radius_m);
  if (cells->empty()) {
    // Any place within the radius lies in a cell whose middle is at most half a diagonal off.
    const double half_diagonal_m = std::sqrt(0.5) * costs_.grid.cell_m;
    cells =
        &search_.find(costs_, robot, situation.target, situation.target_radius_m + half_diagonal_m);
  }
  if (cells->empty()) state_.closed.clear();
  if (!cells->empty()) map::pull_tight(costs_, *cells, robot, state_.path);
}

/// What the cells of a map cost. Where the robot stands it can be, whatever the map says.
void AStarPlanner::charge(const RoomView& view, const core::Vec2& robot) {
  costs_.grid = view.grid;
  costs_.clearance = view.room;
  costs_.cost.resize(view.room.size());
  std::transform(view.room.begin(), view.room.end(), costs_.cost.begin(),
                 [&](map::Clearance room) { return cost_of(room); });
  for (const core::Vec2& place : state_.closed) {
    map::cells_within(costs_.grid, place, kClosed_m, cells_);
    for (const map::Cell& cell : cells_)
      costs_.cost[costs_.grid.index(cell)] = map::Costmap::kBlocked;
  }
  const auto own = costs_.grid.cell_at(robot);
  if (!own) return;
  float& cost = costs_.cost[costs_.grid.index(*own)];
  if (cost == map::Costmap::kBlocked) cost = static_cast<float>(parameters_.touching_cost);
}

float AStarPlanner::cost_of(map::Clearance room) const {
  switch (room) {
    case map::Clearance::kNone:
      break;
    case map::Clearance::kTouching:
      return static_cast<float>(parameters_.touching_cost);
    case map::Clearance::kSuspected:
      return static_cast<float>(parameters_.suspected_cost);
    case map::Clearance::kNarrow:
      return static_cast<float>(parameters_.narrow_cost);
    case map::Clearance::kOpen:
      return 1.0F;
  }
  return map::Costmap::kBlocked;
}

/// Finds the piece of the path that the robot is beside, not before the last one, and how far from
/// that piece's beginning. The path exists.
double AStarPlanner::pass(const core::Vec2& robot) {
  const auto& path = state_.path;
  double least_m = HUGE_VAL;
  double along_m = 0.0;
  for (std::uint32_t i = state_.piece; i + 1 < path.size(); ++i) {
    const core::Vec2 nearest = core::nearest_on_segment(path[i], path[i + 1], robot);
    const double distance_m = core::length(nearest - robot);
    if (distance_m >= least_m) continue;
    least_m = distance_m;
    along_m = core::length(nearest - path[i]);
    state_.piece = i;
  }
  return along_m;
}

/// The place so far along the path from the beginning of the robot's piece.
AStarPlanner::Ahead AStarPlanner::ahead(double along_m) const {
  const auto& path = state_.path;
  for (std::size_t i = state_.piece; i + 1 < path.size(); ++i) {
    const double piece_m = core::length(path[i + 1] - path[i]);
    if (along_m < piece_m) return {path[i] + along_m / piece_m * (path[i + 1] - path[i]), false};
    along_m -= piece_m;
  }
  return {path.back(), true};
}

/// The place on the path to steer for now.
Subgoal AStarPlanner::pursued(const Situation& situation, const core::Vec2& robot) {
  const double from_m = pass(robot);
  const double ahead_m =
      std::clamp(std::fabs(situation.odometry.speed_mps) * parameters_.look_ahead_s,
                 parameters_.least_look_ahead_m, parameters_.most_look_ahead_m);
  Ahead place{};
  for (const double share : kShares) {
    place = ahead(from_m + share * ahead_m);
    if (situation.map.line_of_sight(robot, place.place, map::Clearance::kNarrow)) break;
  }
  return {place.place, place.is_end ? situation.target_radius_m : parameters_.least_look_ahead_m};
}

void AStarPlanner::save(core::StateWriter& writer) const { writer(state_); }

void AStarPlanner::load(core::StateReader& reader) {
  reader(state_);
  const bool on_path = state_.path.empty() ? state_.piece == 0 : state_.piece < state_.path.size();
  const bool valid = on_path && state_.closed.size() <= kMostClosed;
  if (!reader.check(valid, "the path has no such piece")) state_ = {};
}

}  // namespace clew::plan
