// SPDX-License-Identifier: Apache-2.0
#include "drive/unicycle.hpp"

#include <algorithm>
#include <cmath>

#include "drive/arc.hpp"

namespace clew::drive {

core::Result<std::unique_ptr<Unicycle>> Unicycle::create(const Parameters& parameters,
                                                         const domain::BehaviourSetup& setup) {
  return std::make_unique<Unicycle>(parameters, 2.0 * setup.robot.radius_m);
}

domain::MotionLimits Unicycle::limits() const {
  return {parameters_.max_speed_mps, parameters_.max_turn_rate_radps,
          parameters_.max_acceleration_mps2, parameters_.max_turn_acceleration_radps2};
}

Legs Unicycle::legs(const domain::Motion& motion, const Velocities& before) const {
  const Parameters& p = parameters_;
  if (motion.kind == domain::CommandKind::kStop || motion.kind == domain::CommandKind::kGiveUp) {
    return arc_of({}, p.tick_s);
  }
  const Velocities asked = domain::to_velocities(motion, p.tick_s, wheel_base_m_);
  const double excess = std::max({1.0, std::fabs(asked.speed_mps) / p.max_speed_mps,
                                  std::fabs(asked.turn_rate_radps) / p.max_turn_rate_radps});
  const double speed_change = p.max_acceleration_mps2 * p.tick_s;
  const double turn_change = p.max_turn_acceleration_radps2 * p.tick_s;
  return arc_of({std::clamp(asked.speed_mps / excess, before.speed_mps - speed_change,
                            before.speed_mps + speed_change),
                 std::clamp(asked.turn_rate_radps / excess, before.turn_rate_radps - turn_change,
                            before.turn_rate_radps + turn_change)},
                p.tick_s);
}

}  // namespace clew::drive
