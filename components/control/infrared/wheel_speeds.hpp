// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "domain/messages.hpp"

namespace clew::control {

/// V_L and V_R of Wang, Yang & Meng, eq. 1: speeds of the wheels of a differential drive.
struct WheelSpeeds {
  double left_mps = 0.0;
  double right_mps = 0.0;
};

inline WheelSpeeds operator+(const WheelSpeeds& a, const WheelSpeeds& b) {
  return {a.left_mps + b.left_mps, a.right_mps + b.right_mps};
}

inline domain::Motion to_motion(const WheelSpeeds& speeds) {
  domain::Motion motion;
  motion.kind = domain::CommandKind::kWheelSpeeds;
  motion.left_mps = speeds.left_mps;
  motion.right_mps = speeds.right_mps;
  return motion;
}

}  // namespace clew::control
