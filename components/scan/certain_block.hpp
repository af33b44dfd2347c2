// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "domain/messages.hpp"

namespace clew::scan {

/// Whether something that a scan shows is certainly in the way of a disc that moves straight from
/// the robot's place, for `length_m` toward `bearing_rad` from the heading.
///
/// A beam of some width returns from somewhere on an arc: that is in the way for certain if both
/// ends of the arc and its middle are. So a return that may lie beside the way leaves it open, and
/// what is behind the end of the way does not count. Costs one pass over the beams.
bool is_certainly_blocked(const domain::Scan& scan, double radius_m, double bearing_rad,
                          double length_m);

/// Whether a beam looks toward a bearing, or two beams that leave no more than a step between them.
bool is_in_view(const domain::Scan& scan, double bearing_rad);

}  // namespace clew::scan
