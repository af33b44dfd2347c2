// SPDX-License-Identifier: Apache-2.0
#include "drive/velocities.hpp"

namespace clew::drive {

using domain::CommandKind;

Velocities to_velocities(const domain::Motion& motion, double tick_s, double wheel_base_m) {
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

Legs arc_of(const Velocities& velocities, double tick_s) {
  Legs legs;
  legs.push_back({0.0, velocities.speed_mps * tick_s, tick_s, velocities.turn_rate_radps * tick_s});
  return legs;
}

}  // namespace clew::drive
