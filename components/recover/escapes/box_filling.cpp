// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/box_filling.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace clew::recover {
namespace {

// Coming nearer to the target by less is no progress.
constexpr double kNearer_m = 0.05;

}  // namespace

core::Result<std::unique_ptr<BoxFilling>> BoxFilling::create(const Parameters& parameters,
                                                             const domain::BehaviourSetup& setup) {
  return std::make_unique<BoxFilling>(parameters, setup.tick_s);
}

BoxFilling::BoxFilling(const Parameters& parameters, double tick_s)
    : parameters_(parameters),
      tick_s_(tick_s),
      trail_(parameters.trail_spacing_m, static_cast<std::size_t>(parameters.trail_capacity)),
      stack_(parameters.close_m, parameters.patience_s / tick_s) {}

void BoxFilling::watch(const Situation& situation) {
  trail_.add(situation.pose().position(), situation.odometry.travel_m);
}

void BoxFilling::begin(const Situation& situation, const TrapEvidence& evidence) {
  state_ = {};
  stack_.clear();
  take_up(situation, evidence);
}

bool BoxFilling::take_up(const Situation& situation, const TrapEvidence& evidence) {
  if (state_.boxes.full() || stack_.full()) {
    state_.full = true;
    return true;
  }
  const double back_m = evidence.earlier ? evidence.earlier->travel_m : parameters_.recent_m;
  const VirtualObstacle box =
      widened(trail_.bounds(situation.odometry.travel_m - back_m), parameters_.least_size_m);
  const core::Vec2 goal_odom = stack_.empty() ? situation.target_odom : stack_.top_odom();
  const core::Vec2 subgoal_odom = point_opposite(box, goal_odom, parameters_.beyond_m);
  state_.boxes.push_back(box);
  stack_.push(subgoal_odom, situation.tick);
  keep_clear_of(situation.target_odom);
  for (const GoalStack::Goal& goal : stack_.state().goals) keep_clear_of(goal.position_odom);
  return true;
}

EscapeStatus BoxFilling::step(const Situation& situation, domain::Guidance& guidance) {
  if (state_.full) {
    guidance.why = "no room for another virtual obstacle";
    return EscapeStatus::kFailed;
  }
  if (stack_.update(situation) != GoalStack::Change::kNone) pursue_target_anew(situation);
  if (stack_.empty()) watch_target(situation);
  if (state_.boxes.empty() && stack_.empty()) {
    guidance.why = "virtual obstacles did not help";
    return EscapeStatus::kFailed;
  }
  if (!stack_.empty()) {
    guidance.target_x_m = stack_.top_odom().x();
    guidance.target_y_m = stack_.top_odom().y();
    guidance.target_is_virtual = true;
  }
  guidance.virtual_obstacles = state_.boxes;
  guidance.why = std::to_string(state_.boxes.size()) + " virtual obstacles";
  return EscapeStatus::kActive;
}

/// Cuts all boxes clear of a point, and removes those of which nothing is left.
void BoxFilling::keep_clear_of(const core::Vec2& point_odom) {
  std::size_t kept = 0;
  for (const VirtualObstacle& box : state_.boxes) {
    const auto clear =
        cut_clear(box, point_odom, parameters_.clearance_m, parameters_.least_size_m);
    if (clear) state_.boxes[kept++] = *clear;
  }
  state_.boxes.resize(kept);
}

void BoxFilling::pursue_target_anew(const Situation& situation) {
  state_.target_least_m = std::numeric_limits<double>::infinity();
  state_.target_tick = situation.tick;
}

/// Opens the boxes, one by one, if the robot does not come nearer to the target.
void BoxFilling::watch_target(const Situation& situation) {
  const double distance_m = situation.target_distance_m();
  if (distance_m < state_.target_least_m - kNearer_m) {
    state_.target_least_m = distance_m;
    state_.target_tick = situation.tick;
    return;
  }
  const double elapsed_s = static_cast<double>(situation.tick - state_.target_tick) * tick_s_;
  if (elapsed_s <= parameters_.goal_patience_s || state_.boxes.empty()) return;
  state_.target_tick = situation.tick;
  const std::size_t last = state_.boxes.size() - 1;
  const auto half = halved(state_.boxes[last], parameters_.least_size_m);
  if (half) {
    state_.boxes[last] = *half;
  } else {
    state_.boxes.resize(last);
  }
}

void BoxFilling::save(core::StateWriter& writer) const {
  writer(state_, trail_.points(), stack_.state());
}

void BoxFilling::load(core::StateReader& reader) {
  reader(state_, trail_.points(), stack_.state());
}

}  // namespace clew::recover
