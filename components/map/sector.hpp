// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/geometry.hpp"

namespace clew::map {

/// From `from` to `to`; empty if from > to.
struct Interval {
  double from = 0.0;
  double to = 0.0;
};

/// The sector of a disc, or all of it: convex, so that a line cuts it in one piece.
class Sector {
 public:
  /// Opens counter-clockwise from `bearing_right_rad` by `opening_rad`, > 0 and at most pi.
  Sector(const core::Vec2& apex, double radius_m, double bearing_right_rad, double opening_rad);
  /// The whole disc.
  Sector(const core::Vec2& centre, double radius_m);

  /// Where the line of this y cuts it, in x.
  Interval at_y(double y_m) const;
  /// Corners of the rectangle around it.
  const core::Vec2& least() const { return least_; }
  const core::Vec2& most() const { return most_; }

 private:
  core::Vec2 apex_;
  double radius_m_;
  bool whole_;
  core::Vec2 right_ = core::Vec2::UnitX();  ///< direction of the side that comes first
  core::Vec2 left_ = core::Vec2::UnitX();
  core::Vec2 least_;
  core::Vec2 most_;
};

}  // namespace clew::map
