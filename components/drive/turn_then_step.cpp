// SPDX-License-Identifier: Apache-2.0
#include "drive/turn_then_step.hpp"

#include <algorithm>

namespace clew::drive {
using domain::Motion;

core::Result<std::unique_ptr<TurnThenStep>> TurnThenStep::create(
    const Parameters& parameters, const domain::BehaviourSetup& setup) {
  return std::make_unique<TurnThenStep>(parameters, 2.0 * setup.robot.radius_m);
}

domain::MotionLimits TurnThenStep::limits() const {
  domain::MotionLimits limits;
  limits.speed_mps = parameters_.max_step_m / parameters_.tick_s;
  limits.turn_rate_radps = parameters_.max_turn_rad / parameters_.tick_s;
  return limits;
}

Legs TurnThenStep::legs(const Motion& motion, const Velocities&) const {
  const Motion asked = domain::to_turn_and_step(motion, parameters_.tick_s, wheel_base_m_);
  Legs legs;
  legs.push_back({std::clamp(asked.turn_rad, -parameters_.max_turn_rad, parameters_.max_turn_rad),
                  std::clamp(asked.step_m, 0.0, parameters_.max_step_m), parameters_.tick_s, 0.0});
  return legs;
}

}  // namespace clew::drive
