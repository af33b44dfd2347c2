// SPDX-License-Identifier: Apache-2.0
#include "control/final_approach.hpp"

#include <algorithm>
#include <cmath>

#include "scan/certain_block.hpp"

namespace clew::control {
namespace {

constexpr double kBeside_rad = core::radians(60.0);
// A robot this near to where it believes the target to be, and not there, has drifted.
constexpr double kThere_m = 0.01;

}  // namespace

std::optional<domain::Motion> FinalApproach::step(const domain::Odometry& odometry,
                                                  const domain::Scan& scan,
                                                  const core::Vec2& target_odom) {
  if (target_odom != state_.target_odom) state_ = {target_odom};
  const core::Pose2& pose = odometry.pose_odom_robot;
  const double distance_m = core::distance_m(pose, target_odom);
  const double bearing_rad = core::bearing_rad(pose, target_odom);
  const bool sets_off = odometry.travel_m == 0.0 && distance_m <= parameters_.set_off_m &&
                        std::fabs(bearing_rad) > kBeside_rad;
  if (parameters_.approach_m > 0.0 && sets_off) return turn(bearing_rad);
  state_.was_there = state_.was_there || distance_m <= kThere_m;
  if (distance_m > reach_m()) {
    if (parameters_.first_m > 0.0 && !state_.blocked) note_blocked(pose.position());
    return std::nullopt;
  }
  if (state_.was_there) return std::nullopt;
  const bool in_view = scan::is_in_view(scan, bearing_rad);
  if (scan::is_certainly_blocked(scan, radius_m_, bearing_rad, distance_m)) {
    note_blocked(pose.position());
    return std::nullopt;
  }
  if (steers_still(pose.position(), in_view)) return std::nullopt;
  domain::Motion motion = turn(bearing_rad);
  if (std::fabs(bearing_rad) <= parameters_.turn_first_rad) motion.step_m = step_m(distance_m);
  return motion;
}

/// On the spot, as far as a tick lets it.
domain::Motion FinalApproach::turn(double bearing_rad) const {
  domain::Motion motion;
  motion.kind = domain::CommandKind::kTurnAndStep;
  const double most_rad = limits_.turn_rate_radps * tick_s_;
  motion.turn_rad = std::clamp(bearing_rad, -most_rad, most_rad);
  return motion;
}

void FinalApproach::hold(const domain::Odometry& odometry) {
  state_.held = true;
  state_.from_odom = odometry.pose_odom_robot.position();
}

void FinalApproach::note_blocked(const core::Vec2& position_odom) {
  state_.blocked = true;
  state_.from_odom = position_odom;
}

/// How far from the target it begins.
double FinalApproach::reach_m() const {
  if (parameters_.approach_m == 0.0 || state_.blocked || state_.held) return parameters_.approach_m;
  return std::max(parameters_.approach_m, parameters_.first_m);
}

/// Whether the controller must steer, since the robot has tried or looked near here.
bool FinalApproach::steers_still(const core::Vec2& position_odom, bool in_view) const {
  const bool near_there = core::length(position_odom - state_.from_odom) < parameters_.look_again_m;
  return near_there && (state_.held || (state_.blocked && !in_view));
}

/// The longest step after which the drive can come to rest at the target.
double FinalApproach::step_m(double distance_m) const {
  const double most_m = limits_.speed_mps * tick_s_;
  if (std::isinf(limits_.acceleration_mps2)) return std::min(most_m, distance_m);
  const double change_mps = limits_.acceleration_mps2 * tick_s_;
  const double stopping_m =
      tick_s_ * (std::sqrt(change_mps * change_mps + 2.0 * limits_.acceleration_mps2 * distance_m) -
                 change_mps);
  return std::min(most_m, stopping_m);
}

}  // namespace clew::control
