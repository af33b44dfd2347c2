// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/following/flanks.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "scan/nearest_return.hpp"

namespace clew::recover {
namespace {

constexpr double kMargin_rad = core::radians(5.0);

}  // namespace

Side obstacle_side(const Situation& situation) {
  const double bearing_rad = scan::nearest_return(situation.scan).bearing_rad;
  const bool ahead = std::fabs(bearing_rad) < 0.5 * situation.scan.beam_width_rad;
  return side_of(ahead ? situation.target_bearing_rad() : bearing_rad);
}

double turn_about_rad(double obstacle_bearing_rad, double target_bearing_rad) {
  const double obstacle_rad = std::fabs(obstacle_bearing_rad);
  const double target_rad = std::fabs(target_bearing_rad);
  const double least_rad = std::max(obstacle_rad, core::kPi - target_rad);
  const double most_rad = std::min(core::kPi + obstacle_rad, 2.0 * core::kPi - target_rad);
  const double margin_rad = std::min(kMargin_rad, 0.5 * (most_rad - least_rad));
  const double abeam_rad = 0.5 * core::kPi + obstacle_rad;
  return sign(side_of(obstacle_bearing_rad)) *
         std::clamp(abeam_rad, least_rad + margin_rad, most_rad - margin_rad);
}

}  // namespace clew::recover
