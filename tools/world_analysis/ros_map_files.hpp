// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "world/world.hpp"

namespace clew::world_analysis {

/// A map as ROS's map_server reads it: two files.
struct RosMapFiles {
  std::string head;     ///< YAML
  std::string picture;  ///< PGM, binary (P5)
};

/// The map of what does not move in a world, as a robot that has been everywhere would have drawn
/// it: black where an obstacle is within a cell or touches it, white elsewhere. The picture's name
/// in the head is the world's.
///
/// cell_m: side of a cell, > 0.
RosMapFiles ros_map_of(const world::World& world, double cell_m);

}  // namespace clew::world_analysis
