// SPDX-License-Identifier: Apache-2.0
#include "scan/seven_cones.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace clew::scan {
namespace {

// Beams that only touch a sector's edge do not see it.
constexpr double kTouching_rad = core::radians(0.01);

double sector_rad(std::size_t i) { return (3.0 - static_cast<double>(i)) * SevenCones::kWidth_rad; }

bool reaches(double bearing_rad, double beam_width_rad, std::size_t sector) {
  const double off_rad = std::fabs(core::wrap_angle_rad(bearing_rad - sector_rad(sector)));
  return off_rad < 0.5 * (SevenCones::kWidth_rad + beam_width_rad) - kTouching_rad;
}

}  // namespace

core::Result<void> SevenCones::check(const domain::ScanLayout& layout,
                                     const std::string& behaviour) {
  for (std::size_t sector = 0; sector < kCount; ++sector) {
    bool seen = false;
    for (std::size_t i = 0; i < layout.beam_count && !seen; ++i) {
      const double bearing_rad =
          layout.bearing_first_rad + static_cast<double>(i) * layout.bearing_step_rad;
      seen = reaches(bearing_rad, layout.beam_width_rad, sector);
    }
    if (seen) continue;
    const auto at_deg = std::lround(core::degrees(sector_rad(sector)));
    return core::Error{behaviour +
                       " needs a beam in each of seven sectors of 15 deg, from 45 deg " +
                       "to -45 deg; '" + layout.sensor + "' has none in the one at " +
                       std::to_string(at_deg) + " deg"};
  }
  return {};
}

bool SevenCones::are(const domain::ScanLayout& layout) {
  constexpr double kTolerance_rad = core::radians(0.1);
  return layout.beam_count == kCount &&
         std::fabs(layout.bearing_first_rad - sector_rad(0)) < kTolerance_rad &&
         std::fabs(layout.bearing_step_rad + kWidth_rad) < kTolerance_rad &&
         layout.range_max_m > 0.0;
}

const domain::Scan& SevenCones::see(const domain::Scan& scan) {
  cones_.stamp = scan.stamp;
  cones_.bearing_first_rad = sector_rad(0);
  cones_.bearing_step_rad = -kWidth_rad;
  cones_.beam_width_rad = kWidth_rad;
  cones_.range_min_m = scan.range_min_m;
  cones_.range_max_m = std::min(range_m_, scan.range_max_m);
  cones_.ranges_m.assign(kCount, cones_.range_max_m);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double bearing_rad = scan.bearing_rad(i);
    if (scan.ranges_m[i] >= cones_.range_max_m) continue;
    for (std::size_t sector = 0; sector < kCount; ++sector) {
      if (!reaches(bearing_rad, scan.beam_width_rad, sector)) continue;
      cones_.ranges_m[sector] = std::min(cones_.ranges_m[sector], scan.ranges_m[i]);
    }
  }
  return cones_;
}

}  // namespace clew::scan
