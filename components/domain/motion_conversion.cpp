// SPDX-License-Identifier: Apache-2.0
#include "domain/motion_conversion.hpp"

namespace clew::domain {

Velocities to_velocities(const Motion& motion, double tick_s, double wheel_base_m) {
  switch (motion.kind) {
    case CommandKind::kTurnAndStep:
      return {motion.step_m / tick_s, motion.turn_rad / tick_s};
    case CommandKind::kVelocities:
      return {motion.speed_mps, motion.turn_rate_radps};
    case CommandKind::kWheelSpeeds:
      return {0.5 * (motion.left_mps + motion.right_mps),
              (motion.right_mps - motion.left_mps) / wheel_base_m};
    case CommandKind::kStop:
    case CommandKind::kGiveUp:
      break;
  }
  return {};
}

Motion to_turn_and_step(const Motion& motion, double tick_s, double wheel_base_m) {
  if (motion.kind == CommandKind::kTurnAndStep) return motion;
  const Velocities velocities = to_velocities(motion, tick_s, wheel_base_m);
  Motion converted;
  converted.kind = CommandKind::kTurnAndStep;
  converted.turn_rad = velocities.turn_rate_radps * tick_s;
  converted.step_m = velocities.speed_mps * tick_s;
  return converted;
}

}  // namespace clew::domain
