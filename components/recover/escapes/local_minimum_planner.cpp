// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/local_minimum_planner.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace clew::recover {
namespace {

/// A place that a beam points at.
struct Return {
  double bearing_rad = 0.0;
  double range_m = 0.0;
};

/// The outermost return on a side, up to a bearing; without any, the end of the outermost beam.
Return outermost(const domain::Scan& scan, Side side, double most_rad) {
  std::optional<Return> found;
  Return beam_end;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double bearing_rad = core::wrap_angle_rad(scan.bearing_rad(i));
    const double off_rad = sign(side) * bearing_rad;
    if (off_rad < 0.0 || off_rad > most_rad) continue;
    if (off_rad >= sign(side) * beam_end.bearing_rad) beam_end = {bearing_rad, scan.range_max_m};
    if (scan.ranges_m[i] >= scan.range_max_m) continue;
    if (!found || off_rad > sign(side) * found->bearing_rad) {
      found = Return{bearing_rad, scan.ranges_m[i]};
    }
  }
  return found.value_or(beam_end);
}

}  // namespace

core::Result<std::unique_ptr<LocalMinimumPlanner>> LocalMinimumPlanner::create(
    const Parameters& parameters, const domain::BehaviourSetup& setup) {
  return std::make_unique<LocalMinimumPlanner>(parameters, setup.tick_s, setup.robot.radius_m);
}

LocalMinimumPlanner::LocalMinimumPlanner(const Parameters& parameters, double tick_s,
                                         double radius_m)
    : parameters_(parameters),
      radius_m_(radius_m),
      stack_(parameters.close_m, parameters.patience_s / tick_s) {}

void LocalMinimumPlanner::begin(const Situation& situation, const TrapEvidence& evidence) {
  stack_.clear();
  take_up(situation, evidence);
}

bool LocalMinimumPlanner::take_up(const Situation& situation, const TrapEvidence&) {
  const auto target_odom = new_target(situation);
  if (target_odom && !stack_.full()) {
    remember(*target_odom);
    stack_.push(*target_odom, situation.tick);
  } else if (!stack_.empty()) {
    stack_.pop(situation.tick);
  }
  return true;
}

EscapeStatus LocalMinimumPlanner::step(const Situation& situation, domain::Guidance& guidance) {
  if (stack_.empty()) {
    guidance.why = "a virtual target at the same place again";
    return EscapeStatus::kFailed;
  }
  const GoalStack::Change change = stack_.update(situation);
  if (stack_.empty()) {
    if (change == GoalStack::Change::kReached) return EscapeStatus::kEnded;
    guidance.why = "did not come nearer to the virtual target";
    return EscapeStatus::kFailed;
  }
  guidance.target_x_m = stack_.top_odom().x();
  guidance.target_y_m = stack_.top_odom().y();
  guidance.target_is_virtual = true;
  guidance.why = "virtual target";
  return EscapeStatus::kActive;
}

/// The virtual target for this trap, unless both sides' were had before.
std::optional<core::Vec2> LocalMinimumPlanner::new_target(const Situation& situation) const {
  const double rta_rad = core::bearing_rad(situation.pose(), situation.pursued_odom);
  const Side side = side_of(situation, rta_rad);
  const core::Vec2 by_the_paper = target_beside(situation, side, rta_rad);
  if (!was_had(by_the_paper)) return by_the_paper;
  const core::Vec2 mirrored = target_beside(situation, opposite(side), -rta_rad);
  if (!was_had(mirrored)) return mirrored;
  return std::nullopt;
}

/// The target's side; where it is ahead, that of the nearer virtual target.
Side LocalMinimumPlanner::side_of(const Situation& situation, double rta_rad) const {
  if (std::fabs(rta_rad) >= parameters_.ahead_rad) {
    return rta_rad >= 0.0 ? Side::kLeft : Side::kRight;
  }
  const auto distance_m = [&](Side side) {
    return outermost(situation.scan, side, parameters_.outermost_rad).range_m;
  };
  return distance_m(Side::kLeft) <= distance_m(Side::kRight) ? Side::kLeft : Side::kRight;
}

/// Eqs 1 to 4: both the shift by alpha and the turn keep the robot's place.
core::Vec2 LocalMinimumPlanner::target_beside(const Situation& situation, Side side,
                                              double turn_rad) const {
  const Return at = outermost(situation.scan, side, parameters_.outermost_rad);
  const core::Pose2& pose = situation.pose();
  const double distance_m = radius_m_ + at.range_m + parameters_.alpha_m;
  return pose.position() +
         distance_m * core::direction(pose.heading_rad + at.bearing_rad + turn_rad);
}

void LocalMinimumPlanner::remember(const core::Vec2& target_odom) {
  state_.had_odom.push_back(target_odom);
  if (state_.had_odom.size() > kRemembered) state_.had_odom.pop_front();
}

bool LocalMinimumPlanner::was_had(const core::Vec2& target_odom) const {
  return std::any_of(state_.had_odom.begin(), state_.had_odom.end(), [&](const core::Vec2& had) {
    return core::length(had - target_odom) <= parameters_.same_place_m;
  });
}

void LocalMinimumPlanner::save(core::StateWriter& writer) const { writer(state_, stack_.state()); }

void LocalMinimumPlanner::load(core::StateReader& reader) { reader(state_, stack_.state()); }

}  // namespace clew::recover
