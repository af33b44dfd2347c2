// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "world/cone.hpp"
#include "world/ray_fan.hpp"

namespace clew::world {

/// Looks at obstacles one after the other, each only along the rays of a fan that may meet it: a
/// scan of hundreds of rays costs a few angles an obstacle and one intersection a ray that hits,
/// where asking ray by ray searches the tree hundreds of times. What a ray finds is what
/// Cone::squared_distance finds, bit for bit.
class FanSweep {
 public:
  /// `squared_distances` has a value a ray, set to the square of the reach beforehand; look()
  /// lowers them.
  FanSweep(const RayFan& fan, const Pose2& pose, double* squared_distances);

  const Vec2& apex() const { return apex_; }

  void look(const World::Segment& segment);
  void look(const World::Circle& circle);

 private:
  template <typename Shape>
  void look(const Shape& shape, double low_rad, double span_rad);
  template <typename Shape>
  void look_along(const Shape& shape, double first, double last);

  const RayFan& fan_;
  Vec2 apex_;
  Vec2 heading_;
  double first_rad_;  // of ray 0, world frame
  double* squared_distances_;
};

}  // namespace clew::world
