// SPDX-License-Identifier: Apache-2.0
#include "scan/certain_block.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "core/math.hpp"

namespace clew::scan {
namespace {

// A disc this much smaller passes: of a place known to a beam's width, no more can be said.
constexpr double kTolerance_m = 0.01;

}  // namespace

bool is_certainly_blocked(const domain::Scan& scan, double radius_m, double bearing_rad,
                          double length_m) {
  const double room_m = radius_m - kTolerance_m;
  const auto blocks = [&](double distance_m, double off_way_rad) {
    const double ahead_m = distance_m * core::cos(off_way_rad);
    const double beside_m = distance_m * core::sin(off_way_rad);
    const double past_m = ahead_m - std::clamp(ahead_m, 0.0, length_m);
    return past_m * past_m + beside_m * beside_m < room_m * room_m;
  };
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double distance_m = scan.ranges_m[i] + radius_m;
    if (scan.ranges_m[i] >= scan.range_max_m || distance_m - room_m >= length_m) continue;
    const double off_rad = core::wrap_angle_rad(scan.bearing_rad(i) - bearing_rad);
    const double half_rad = 0.5 * scan.beam_width_rad;
    if (blocks(distance_m, off_rad) && blocks(distance_m, off_rad - half_rad) &&
        blocks(distance_m, off_rad + half_rad)) {
      return true;
    }
  }
  return false;
}

bool is_in_view(const domain::Scan& scan, double bearing_rad) {
  constexpr double kRounding_rad = 1e-9;
  const double half_rad =
      0.5 * std::max(std::fabs(scan.bearing_step_rad), scan.beam_width_rad) + kRounding_rad;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (std::fabs(core::wrap_angle_rad(scan.bearing_rad(i) - bearing_rad)) <= half_rad) return true;
  }
  return false;
}

}  // namespace clew::scan
