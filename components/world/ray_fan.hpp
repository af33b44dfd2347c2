// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry.hpp"

namespace clew::world {

/// Rays from the robot's centre at equal angles, as a laser scanner has them: made once by a
/// sensor, turned with the robot by every query.
class RayFan {
 public:
  /// Ray i looks bearing_first_rad + i bearing_step_rad from the heading. The step is not 0, and
  /// all rays together go at most once around.
  RayFan(double bearing_first_rad, double bearing_step_rad, std::size_t count);

  std::size_t size() const { return axes_.size(); }
  double bearing_first_rad() const { return bearing_first_rad_; }
  double bearing_step_rad() const { return bearing_step_rad_; }
  /// Unit vector of a ray in the robot's frame.
  const core::Vec2& axis(std::size_t i) const { return axes_[i]; }

 private:
  double bearing_first_rad_;
  double bearing_step_rad_;
  std::vector<core::Vec2> axes_;
};

}  // namespace clew::world
