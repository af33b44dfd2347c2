// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/geometry.hpp"
#include "world/world.hpp"

namespace clew::fleet {

/// Another robot, as one robot's world has it: a disc that jumps from place to place.
struct OtherRobot {
  double radius_m = 0.0;
  std::vector<world::MovingObstacle::Waypoint> path;  ///< at least one
};

/// The world of one robot as a file: what the fleet's world has, then the others as moving
/// obstacles. Each number is written so that reading gives the same bits.
std::string robot_world_text(const world::World& world, const core::Pose2& start,
                             const world::Waypoint& target, const std::vector<OtherRobot>& others);

}  // namespace clew::fleet
