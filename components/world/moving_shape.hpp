// SPDX-License-Identifier: Apache-2.0
/// Moving shapes that are no discs, made of moving discs: a row of them along each side, so close
/// that no ray and no robot gets through. Queries know discs alone, and so meet any shape.
#pragma once

#include <vector>

#include "core/result.hpp"
#include "world/polygon.hpp"
#include "world/world.hpp"

namespace clew::world {

/// Half the thickness of a side. The discs' centres are on the side, so a shape is as much larger.
inline constexpr double kSideRadius_m = 0.02;
/// Of all shapes of a world together; and of the points of these discs' paths.
inline constexpr std::size_t kMostSideDiscs = 4000;
inline constexpr std::size_t kMostSidePoints = 1'000'000;

/// Between the points of a moving obstacle's path; bounds the legs in one tick.
inline constexpr double kLeastStep_s = 1e-3;

/// How a door stands over time.
struct Turn {
  double time_s = 0.0;
  double angle_rad = 0.0;  ///< of the leaf, counter-clockwise from the x axis; may be any
};

/// A leaf that turns about a hinge; linear in the angle between the times.
struct Door {
  Vec2 hinge = Vec2::Zero();
  double length_m = 0.0;
  std::vector<Turn> turns;  ///< at least one; times rise from 0
  bool loop = false;
};

/// A polygon that is moved along a path without being turned. `path` is that of its first point.
struct MovingPolygon {
  Polygon outline;
  std::vector<MovingObstacle::Waypoint> path;
  bool loop = false;
};

/// What a world's shapes may still have.
struct ShapeRoom {
  std::size_t discs = kMostSideDiscs;
  std::size_t points = kMostSidePoints;
};

/// Takes from `room` what the shape needs. Refused: one that needs more, and a door that turns too
/// fast.
core::Result<std::vector<MovingObstacle>> discs_of(const Door& door, ShapeRoom& room);
core::Result<std::vector<MovingObstacle>> discs_of(const MovingPolygon& polygon, ShapeRoom& room);

}  // namespace clew::world
