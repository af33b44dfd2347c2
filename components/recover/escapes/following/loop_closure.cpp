// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/following/loop_closure.hpp"

#include <algorithm>
#include <cmath>

namespace clew::recover {
namespace {

constexpr double kFirstHorizon_m = 10.0;
constexpr double kSameHeading_rad = core::radians(60.0);

double target_angle_rad(const core::Pose2& pose_odom, const core::Vec2& target_odom) {
  return core::atan2(target_odom.y() - pose_odom.y_m, target_odom.x() - pose_odom.x_m);
}

}  // namespace

void LoopClosure::begin(const core::Pose2& pose_odom, double travel_m,
                        const core::Vec2& target_odom) {
  state_ = {};
  state_.horizon_m = kFirstHorizon_m;
  state_.last_odom = pose_odom;
  state_.last_target_angle_rad = target_angle_rad(pose_odom, target_odom);
  move_anchor(pose_odom, travel_m);
}

std::optional<LoopResult> LoopClosure::add(const core::Pose2& pose_odom, double travel_m,
                                           const core::Vec2& target_odom, bool clear, Side wall) {
  const double angle_rad = target_angle_rad(pose_odom, target_odom);
  state_.turned_rad += core::wrap_angle_rad(pose_odom.heading_rad - state_.last_odom.heading_rad);
  state_.wound_rad += core::wrap_angle_rad(angle_rad - state_.last_target_angle_rad);
  state_.last_odom = pose_odom;
  state_.last_target_angle_rad = angle_rad;
  if (clear) {
    state_.nearest_clear_m =
        std::min(state_.nearest_clear_m, core::distance_m(pose_odom, target_odom));
  }

  const double away_m = core::distance_m(state_.anchor_odom, pose_odom.position());
  // Round a small post the robot is never far away: there it has gone round by half a turn.
  const bool half_round =
      std::fabs(state_.turned_rad) > core::kPi && travel_m - state_.anchor_travel_m > radius_m_;
  if (away_m > 2.0 * radius_m_ || half_round) state_.away = true;
  const double heading_change_rad =
      core::wrap_angle_rad(pose_odom.heading_rad - state_.anchor_odom.heading_rad);
  const bool closed =
      state_.away && away_m <= radius_m_ && std::fabs(heading_change_rad) <= kSameHeading_rad;
  if (!closed) {
    if (travel_m - state_.anchor_travel_m > state_.horizon_m) {
      state_.horizon_m *= 2.0;
      move_anchor(pose_odom, travel_m);
    }
    return std::nullopt;
  }
  const bool around_target = std::fabs(state_.wound_rad) > core::kPi;
  const double toward_wall_rad = sign(wall) * state_.turned_rad;
  const bool around_obstacle = toward_wall_rad > core::kPi;
  const bool inside = toward_wall_rad < -core::kPi;
  const bool separates = (around_obstacle && around_target) || (inside && !around_target);
  return separates ? LoopResult::kSeparates : LoopResult::kOpen;
}

void LoopClosure::move_anchor(const core::Pose2& pose_odom, double travel_m) {
  state_.anchor_odom = pose_odom;
  state_.anchor_travel_m = travel_m;
  state_.away = false;
  state_.turned_rad = 0.0;
  state_.wound_rad = 0.0;
  state_.nearest_clear_m = std::numeric_limits<double>::infinity();
}

}  // namespace clew::recover
