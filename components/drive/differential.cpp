// SPDX-License-Identifier: Apache-2.0
#include "drive/differential.hpp"

#include <algorithm>
#include <cmath>

#include "drive/arc.hpp"

namespace clew::drive {

core::Result<std::unique_ptr<Differential>> Differential::create(const Parameters& parameters,
                                                                 const domain::BehaviourSetup&) {
  return std::make_unique<Differential>(parameters);
}

domain::MotionLimits Differential::limits() const {
  domain::MotionLimits limits;
  limits.speed_mps = parameters_.max_wheel_speed_mps;
  limits.turn_rate_radps = 2.0 * parameters_.max_wheel_speed_mps / parameters_.wheel_base_m;
  return limits;
}

Legs Differential::legs(const domain::Motion& motion, const Velocities&) const {
  const Velocities asked =
      domain::to_velocities(motion, parameters_.tick_s, parameters_.wheel_base_m);
  // The faster wheel of eq. 1 turned around: |v| + |omega| L / 2.
  const double wheel_mps = std::fabs(asked.speed_mps) +
                           0.5 * std::fabs(asked.turn_rate_radps) * parameters_.wheel_base_m;
  const double excess = std::max(1.0, wheel_mps / parameters_.max_wheel_speed_mps);
  return arc_of({asked.speed_mps / excess, asked.turn_rate_radps / excess}, parameters_.tick_s);
}

}  // namespace clew::drive
