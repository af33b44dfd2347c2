// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/angle.hpp"
#include "domain/setup.hpp"

namespace clew::control {

/// The layout of the four infrared rangers: left, ahead, right, back.
inline domain::ScanLayout infrared_layout() {
  return {"infrared", 4,   core::radians(90.0),    core::radians(-90.0),
          0.0,        0.8, domain::InfraredCurve{}};
}

/// A scan of theirs, in the order of the paper's sensors.
inline domain::Scan infrared_scan(double ahead_m, double back_m, double left_m, double right_m) {
  domain::Scan scan;
  scan.bearing_first_rad = core::radians(90.0);
  scan.bearing_step_rad = core::radians(-90.0);
  scan.range_min_m = 0.1;
  scan.range_max_m = 0.8;
  scan.ranges_m = {left_m, ahead_m, right_m, back_m};
  return scan;
}

}  // namespace clew::control
