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

}  // namespace clew::world
