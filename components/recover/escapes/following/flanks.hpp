// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "recover/escapes/following/side.hpp"
#include "recover/situation.hpp"

namespace clew::recover {

/// The side of the nearest obstacle; one straight ahead is taken to be on the target's side.
Side obstacle_side(const Situation& situation);

/// The turn after which an obstacle and a target on different sides have both changed sides: cases
/// iii and iv of Krishna & Kalra 2000, section 4.3. It goes toward the obstacle; left is positive.
///
/// With both angles taken off ahead, obstacle at o and target at t, the obstacle has changed sides
/// after more than o and less than 180 deg + o, and the target after more than 180 deg - t and less
/// than 360 deg - t. Of the turns that do both, this is the one nearest to the turn that brings the
/// obstacle abeam, where it can be followed; it keeps 5 deg from either end, or, where less than 10
/// deg lie between them, the middle. So t + o must be more than 0.
double turn_about_rad(double obstacle_bearing_rad, double target_bearing_rad);

}  // namespace clew::recover
