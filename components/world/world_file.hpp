// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "world/polygon.hpp"
#include "world/world.hpp"

namespace clew::world {

/// A moving polygon at time 0. Its sides are discs in WorldFile::moving; this knows its inside.
struct MovingOutline {
  Polygon outline;
  std::uint32_t entry = 0;  ///< index of its entry in the file
};

/// What a world file says, read and checked value by value.
struct WorldFile {
  std::string name;
  std::string about;
  Vec2 bounds_min = Vec2::Zero();
  Vec2 bounds_max = Vec2::Zero();
  std::vector<World::Segment> walls;
  std::vector<Polygon> polygons;
  std::vector<World::Circle> circles;
  std::vector<MovingObstacle> moving;
  std::vector<MovingOutline> moving_outlines;
  std::vector<Vec2> subgoals;
  Pose2 start;
  Vec2 target = Vec2::Zero();
  double target_radius_m = 0.0;
  std::optional<GoalHeading> target_heading;
  std::vector<Waypoint> waypoints;  ///< before the target
  bool has_mission = true;          ///< else the target is no place to go to: the robot waits
  std::optional<bool> solvable;
  std::optional<double> shortest_path_m;
  core::Error start_place;  ///< where the file gives the start; without a message

  /// The sides of the boundary, from the lower one counter-clockwise.
  std::vector<World::Segment> boundary() const;
};

/// Reads a world file; see World::parse.
core::Result<WorldFile> read_world_file(std::string_view yaml, const std::string& file);

/// Puts goals in the place of the file's way-points and target; see World::parse.
core::Result<void> set_goals(const Goals& goals, WorldFile& world);

}  // namespace clew::world
