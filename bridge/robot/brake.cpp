// SPDX-License-Identifier: Apache-2.0
#include "robot/brake.hpp"

#include <algorithm>
#include <cmath>

#include "core/math.hpp"

namespace clew::robot {
namespace {

/// The robot's centre is looked at as often as this along its way.
constexpr double kStep_m = 0.02;
/// Rounding is not coming nearer.
constexpr double kNothing_m = 1e-6;

/// Where the centre is after `time_s` on an arc.
core::Vec2 place_after(const domain::Velocities& v, double time_s) {
  const double turn_rad = v.turn_rate_radps * time_s;
  if (std::fabs(turn_rad) < 1e-6) return {v.speed_mps * time_s, 0.0};
  const double radius_m = v.speed_mps / v.turn_rate_radps;
  return {radius_m * core::sin(turn_rad), radius_m * (1.0 - core::cos(turn_rad))};
}

}  // namespace

std::optional<double> bearing_of_contact_rad(const std::vector<core::Vec2>& obstacles,
                                             double radius_m, const domain::Velocities& velocities,
                                             double horizon_s) {
  const double way_m = std::fabs(velocities.speed_mps) * horizon_s;
  const int steps = static_cast<int>(std::ceil(way_m / kStep_m));
  for (int i = 1; i <= steps; ++i) {
    const core::Vec2 centre = place_after(velocities, horizon_s * i / steps);
    for (const core::Vec2& obstacle : obstacles) {
      const double allowed_m = std::min(radius_m, core::length(obstacle) - kNothing_m);
      if (core::length(obstacle - centre) < allowed_m) {
        return core::atan2(obstacle.y(), obstacle.x());
      }
    }
  }
  return std::nullopt;
}

}  // namespace clew::robot
