// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "core/geometry.hpp"
#include "world/world.hpp"

namespace clew::world {

/// A moving obstacle's path from some time on, leg by leg; on each the velocity is constant. After
/// the last point of a path that does not loop comes one leg without an end.
class PathWalk {
 public:
  PathWalk(const MovingObstacle& obstacle, double time_s);

  /// When the leg ends; infinity if it never does.
  double leg_end_s() const;
  /// Where the obstacle is at a time within the leg.
  Vec2 position_at(double time_s) const;
  /// Goes to the next leg, which a loop that is not closed begins with a jump.
  void advance();

 private:
  const MovingObstacle& obstacle_;
  bool wraps_;
  std::size_t leg_ = 0;    // from waypoint leg_ to the next
  double offset_s_ = 0.0;  // when this round of the loop began
};

/// Times of a path that jumps are those of ticks, which are summed up in several ways.
inline constexpr double kJumpTolerance_s = 1e-6;

/// The point of a path that jumps, at which the obstacle stands right after a time.
std::size_t point_after(const MovingObstacle& obstacle, double time_s);

}  // namespace clew::world
