// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace clew::drive {

/// How a motion differs from what it should be: systematic errors, and standard deviations after a
/// metre or a radian. Of odometry (drift) and of wheels (slip).
struct MotionErrors {
  double m_per_m = 0.0;
  double rad_per_rad = 0.0;
  double rad_per_m = 0.0;
  double m_per_sqrt_m = 0.0;
  double rad_per_sqrt_rad = 0.0;
  double rad_per_sqrt_m = 0.0;

  /// Whether there is any error at all.
  bool any() const {
    return m_per_m != 0.0 || rad_per_rad != 0.0 || rad_per_m != 0.0 || m_per_sqrt_m != 0.0 ||
           rad_per_sqrt_rad != 0.0 || rad_per_sqrt_m != 0.0;
  }

  /// These and others, which are independent of them: sizes add up, and so do variances.
  MotionErrors with(const MotionErrors& other) const {
    const auto both = [](double size, double more) {
      return more == 0.0 ? size : std::fabs(size) + std::fabs(more);
    };
    const auto together = [](double deviation, double more) {
      return more == 0.0 ? deviation : std::sqrt(deviation * deviation + more * more);
    };
    return {both(m_per_m, other.m_per_m),
            both(rad_per_rad, other.rad_per_rad),
            both(rad_per_m, other.rad_per_m),
            together(m_per_sqrt_m, other.m_per_sqrt_m),
            together(rad_per_sqrt_rad, other.rad_per_sqrt_rad),
            together(rad_per_sqrt_m, other.rad_per_sqrt_m)};
  }
};

}  // namespace clew::drive
