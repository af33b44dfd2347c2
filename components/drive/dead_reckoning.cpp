// SPDX-License-Identifier: Apache-2.0
#include "drive/dead_reckoning.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"

namespace clew::drive {

DeadReckoning::DeadReckoning(const core::Pose2& start, const DriftParameters& drift)
    : drift_(drift) {
  state_.pose_odom_robot = start;
}

void DeadReckoning::count(const Tick& tick, const core::Random& random) {
  const double s_m = tick.path_length_m;
  double counted_m = s_m * (1.0 + drift_.m_per_m);
  if (s_m > 0.0 && drift_.m_per_sqrt_m > 0.0) {
    counted_m += drift_.m_per_sqrt_m * std::sqrt(s_m) * random.normal(0);
  }
  counted_m = std::max(counted_m, 0.0);
  double error_rad = drift_.rad_per_rad * tick.turn_rad + drift_.rad_per_m * s_m;
  if (drift_.rad_per_sqrt_m > 0.0) {
    error_rad += drift_.rad_per_sqrt_m * std::sqrt(s_m) * random.normal(1);
  }
  if (drift_.rad_per_sqrt_rad > 0.0) {
    error_rad += drift_.rad_per_sqrt_rad * std::sqrt(std::fabs(tick.turn_rad)) * random.normal(2);
  }

  // The true way of the tick as the robot's frame saw it, turned into the believed frame; half of
  // the tick's error of heading has come up on its middle.
  core::Pose2& pose = state_.pose_odom_robot;
  const core::Vec2 way = tick.to.position() - tick.from.position();
  const core::Vec2 frame =
      core::direction(pose.heading_rad - tick.from.heading_rad + 0.5 * error_rad);
  const double scale = s_m > 0.0 ? counted_m / s_m : 0.0;
  pose.x_m += scale * (frame.x() * way.x() - frame.y() * way.y());
  pose.y_m += scale * (frame.y() * way.x() + frame.x() * way.y());
  pose.heading_rad = core::wrap_angle_rad(pose.heading_rad + tick.turn_rad + error_rad);

  state_.travel_m += counted_m;
  state_.speed_mps = (tick.backwards ? -counted_m : counted_m) / tick.duration_s;
  state_.turn_rate_radps = (tick.turn_rad + error_rad) / tick.duration_s;
}

}  // namespace clew::drive
