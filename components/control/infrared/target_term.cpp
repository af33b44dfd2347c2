// SPDX-License-Identifier: Apache-2.0
#include "control/infrared/target_term.hpp"

#include <algorithm>

#include "core/math.hpp"

namespace clew::control {
WheelSpeeds target_term(const TargetTermParameters& parameters, double target_bearing_rad,
                        const InfraredDistances& distances_m) {
  if (!parameters.enabled) return {};
  const auto freedom = [&](InfraredSide side) {
    return std::clamp(
        (distances_m[side] - kNearestReading_m) / (parameters.free_m - kNearestReading_m), 0.0,
        1.0);
  };
  const double ahead = freedom(kAhead);
  const double beside = freedom(target_bearing_rad > 0.0 ? kLeft : kRight);
  const double speed_mps =
      parameters.speed_mps * ahead * std::max(0.0, core::cos(target_bearing_rad));
  const double turn_mps = parameters.turn_mps * ahead * beside *
                          std::clamp(target_bearing_rad / (0.5 * core::kPi), -1.0, 1.0);
  return {speed_mps - turn_mps, speed_mps + turn_mps};
}

}  // namespace clew::control
