// SPDX-License-Identifier: Apache-2.0
#include "control/heading_turn.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"

namespace clew::control {
namespace {

constexpr double kBegins_ratio = 0.5;  // of the radius
// Here the final approach ends, however small the radius is.
constexpr double kArrives_m = 0.01;

}  // namespace

ActiveTarget ActiveTarget::of(const domain::Guidance& guidance) {
  return {{guidance.target_x_m, guidance.target_y_m},
          guidance.target_radius_m,
          guidance.target_is_virtual,
          guidance.target_has_heading,
          guidance.target_heading_rad,
          guidance.target_heading_tolerance_rad};
}

ActiveTarget ActiveTarget::of(const domain::Target& target) {
  return {target.position(),  target.radius_m,    false,
          target.has_heading, target.heading_rad, target.heading_tolerance_rad};
}

std::optional<domain::Motion> HeadingTurn::step(const core::Pose2& pose_odom_robot,
                                                const ActiveTarget& target) {
  if (!target.has_heading || target.is_virtual) return std::nullopt;
  const double distance_m = core::distance_m(pose_odom_robot, target.position_odom);
  const bool is_new = target.position_odom != state_.target_odom;
  if (is_new || distance_m > target.radius_m) {
    state_ = {target.position_odom, distance_m, false, false};
    if (distance_m > target.radius_m) return std::nullopt;
  }
  const bool comes_nearer = is_new || distance_m < state_.distance_m;
  state_.distance_m = distance_m;
  const double off_rad = core::wrap_angle_rad(target.heading_rad - pose_odom_robot.heading_rad);
  state_.met = state_.met || std::fabs(off_rad) <= target.heading_tolerance_rad;
  state_.turns = state_.turns || !comes_nearer ||
                 distance_m <= std::max(kBegins_ratio * target.radius_m, kArrives_m);
  if (state_.met || !state_.turns) return std::nullopt;
  domain::Motion motion;
  motion.kind = domain::CommandKind::kTurnAndStep;
  const double most = most_rad(off_rad);
  motion.turn_rad = std::clamp(off_rad, -most, most);
  return motion;
}

/// The greatest turn of a tick after which the drive can come to rest at the heading.
double HeadingTurn::most_rad(double off_rad) const {
  const double most_rad = limits_.turn_rate_radps * tick_s_;
  if (std::isinf(limits_.turn_acceleration_radps2)) return most_rad;
  const double change_radps = limits_.turn_acceleration_radps2 * tick_s_;
  const double stopping_rad =
      tick_s_ * (std::sqrt(change_radps * change_radps +
                           2.0 * limits_.turn_acceleration_radps2 * std::fabs(off_rad)) -
                 change_radps);
  return std::min(most_rad, stopping_rad);
}

}  // namespace clew::control
