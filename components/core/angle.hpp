// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "core/math.hpp"

namespace clew::core {

/// The same angle in (-pi, pi].
inline double wrap_angle_rad(double angle_rad) {
  if (angle_rad > -kPi && angle_rad <= kPi) return angle_rad;
  double wrapped = angle_rad - 2.0 * kPi * std::floor(angle_rad / (2.0 * kPi));  // [0, 2 pi]
  if (wrapped > kPi) wrapped -= 2.0 * kPi;
  return wrapped <= -kPi ? kPi : wrapped;
}

/// Degrees to radians: for config keys that end in _deg, and for constants printed in degrees.
inline constexpr double radians(double degrees) { return degrees * (kPi / 180.0); }
inline constexpr double degrees(double radians_value) { return radians_value * (180.0 / kPi); }

}  // namespace clew::core
