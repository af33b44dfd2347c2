// SPDX-License-Identifier: Apache-2.0
#include "classify/spatial_classes.hpp"

#include <algorithm>

#include "core/fuzzy.hpp"

namespace clew::classify {

Nearness nearness(const domain::Scan& scan, const NearnessParameters& parameters) {
  const auto& u_m = scan.ranges_m;
  const auto degree = [&](double reading_m) {
    return core::falling_membership(reading_m / scan.range_max_m, parameters.near_full_ratio,
                                    parameters.near_none_ratio);
  };
  return {degree(std::min({u_m[0], u_m[1], u_m[2]})), degree(u_m[3]),
          degree(std::min({u_m[4], u_m[5], u_m[6]}))};
}

std::uint8_t spatial_class(const Nearness& nearness, const NearnessParameters& parameters) {
  if (nearness.left > parameters.very_near_degree &&
      nearness.centre > parameters.very_near_degree &&
      nearness.right > parameters.very_near_degree) {
    return 0;
  }
  // Rows 1 to 8 count in binary from near near near to far far far: right, centre, left.
  const int right_far = nearness.right < parameters.near_degree ? 4 : 0;
  const int centre_far = nearness.centre < parameters.near_degree ? 2 : 0;
  const int left_far = nearness.left < parameters.near_degree ? 1 : 0;
  return static_cast<std::uint8_t>(1 + right_far + centre_far + left_far);
}

}  // namespace clew::classify
