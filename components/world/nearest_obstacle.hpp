// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "world/world_file.hpp"

namespace clew::world {

/// An obstacle as messages name it: `walls[3]`, `the boundary`.
struct NearestObstacle {
  std::string name;
  double clearance_m = 0.0;  ///< to its surface; 0 inside or on it
};

enum class Obstacles { kStatic, kAllAtTime0 };

/// The obstacle that is nearest to a point, found by looking at all of them: for the few questions
/// asked when a world is loaded.
NearestObstacle nearest_obstacle(const WorldFile& world, const Vec2& point, Obstacles obstacles);

}  // namespace clew::world
