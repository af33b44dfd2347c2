// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>

#include "domain/messages.hpp"

namespace clew::scan {

/// A reading, and the axis of the beam that it is of.
struct Return {
  double range_m = 0.0;
  double bearing_rad = 0.0;
};

/// The shortest reading, the first of equal ones; as far as the scan sees if nothing returned. The
/// scan has at least one beam.
inline Return nearest_return(const domain::Scan& scan) {
  const auto nearest = std::min_element(scan.ranges_m.begin(), scan.ranges_m.end());
  return {*nearest, scan.bearing_rad(static_cast<std::size_t>(nearest - scan.ranges_m.begin()))};
}

}  // namespace clew::scan
