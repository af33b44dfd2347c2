// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/geometry.hpp"
#include "world/world.hpp"

namespace clew::trap_worlds {

using core::Vec2;

/// A world under construction, metres. The way to the target leads up (+y) where a family does not
/// say otherwise.
struct WorldDraft {
  Vec2 start = Vec2::Zero();
  Vec2 target = Vec2::Zero();
  std::vector<world::World::Segment> walls;
  std::vector<world::World::Circle> circles;
  std::vector<std::vector<Vec2>> polygons;
  std::vector<world::MovingObstacle> moving;
  double target_radius_m = 0.2;
  double off_target_rad = 0.0;  ///< of the heading at the start, from the target's direction
  std::string parameters;       ///< what was drawn, for people: `width 1.52 m, ...`
  double border_m = 2.0;        ///< room between all this and the boundary
  bool may_be_turned = true;    ///< by any angle; else by quarter turns, which keep it exact

  /// Adds walls from each point to the next.
  void add_walls(const std::vector<Vec2>& points);
  /// Adds `name value m` to the parameters.
  void say(const std::string& name, double length_m);
  void say_time(const std::string& name, double time_s);
  void say_count(const std::string& name, int count);
};

/// What the finished file says beside the obstacles.
struct WorldClaims {
  std::string name;
  std::string about;
  bool solvable = false;
  bool gives_shortest_path = false;
  double shortest_path_m = 0.0;
};

/// The draft mirrored and turned about the origin, and every number rounded to millimetres, as it
/// will stand in the file.
WorldDraft placed(const WorldDraft& draft, bool mirrored, double angle_rad);

/// The draft as a world file, `clew-world/1`. The robot starts heading for the target.
std::string world_text(const WorldDraft& draft, const WorldClaims& claims);

}  // namespace clew::trap_worlds
