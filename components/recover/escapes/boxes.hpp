// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/geometry.hpp"
#include "domain/messages.hpp"

namespace clew::recover {

using domain::VirtualObstacle;

/// The same box, at least `least_m` wide and high about the same centre.
VirtualObstacle widened(const VirtualObstacle& box, double least_m);

/// The box without the strip that comes within `clearance_m` of a point: of the four ways to cut,
/// the one that leaves most. Nothing if that is thinner than `least_m`.
std::optional<VirtualObstacle> cut_clear(const VirtualObstacle& box, const core::Vec2& point_odom,
                                         double clearance_m, double least_m);

/// The same box at half its size about its centre; nothing if that is thinner than `least_m`.
std::optional<VirtualObstacle> halved(const VirtualObstacle& box, double least_m);

/// Pin & Bender 1996, figure 3: the point `beyond_m` outside the midpoint of the side of the box
/// that lies opposite a goal. That side is the one through which the line from the goal leaves the
/// box at its centre's far side.
core::Vec2 point_opposite(const VirtualObstacle& box, const core::Vec2& goal_odom, double beyond_m);

}  // namespace clew::recover
