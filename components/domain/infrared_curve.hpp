// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace clew::domain {

/// What a triangulating infrared ranger answers: S = K_o + K_g / distance, rounded to 8 bits, of
/// which Wang, Yang & Meng, eq. 2, read I = 255 - S. Sensor and controller share it.
///
/// The curve is the paper's figure's, which is lost: K_o and K_g are those at which S falls by 58
/// from 0.2 to 0.8 m, to 75, the typical values of the data sheet of the Sharp GP2D02.
struct InfraredCurve {
  static constexpr double kLargestByte = 255.0;

  double gain_m = 15.467;  ///< K_g
  double offset = 55.67;   ///< K_o: what the sensor says of nothing

  /// I of eq. 2 for a distance from the skin above 0: a whole number, 0..255, that rises with it.
  double reading(double distance_m) const {
    const double answer = offset + gain_m / distance_m;
    return kLargestByte - std::clamp(std::floor(answer + 0.5), 0.0, kLargestByte);
  }
};

}  // namespace clew::domain
