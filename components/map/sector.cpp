// SPDX-License-Identifier: Apache-2.0
#include "map/sector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clew::map {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Keeps what lies left of a line through the origin, or on it, at height y:
/// d_x y - d_y x >= 0.
void cut(Interval& interval, const core::Vec2& d, double y) {
  if (d.y() > 0.0) {
    interval.to = std::min(interval.to, d.x() * y / d.y());
  } else if (d.y() < 0.0) {
    interval.from = std::max(interval.from, d.x() * y / d.y());
  } else if (d.x() * y < 0.0) {
    interval = {kInfinity, -kInfinity};
  }
}

}  // namespace

Sector::Sector(const core::Vec2& apex, double radius_m, double bearing_right_rad,
               double opening_rad)
    : apex_(apex),
      radius_m_(radius_m),
      whole_(false),
      right_(core::direction(bearing_right_rad)),
      left_(core::direction(bearing_right_rad + opening_rad)),
      least_(apex),
      most_(apex) {
  const auto take = [&](const core::Vec2& direction) {
    const core::Vec2 corner = apex + radius_m * direction;
    least_ = least_.cwiseMin(corner);
    most_ = most_.cwiseMax(corner);
  };
  take(right_);
  take(left_);
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double bearing_rad = quarter * (core::kPi / 2.0);
    double beyond_rad = core::wrap_angle_rad(bearing_rad - bearing_right_rad);
    if (beyond_rad < 0.0) beyond_rad += 2.0 * core::kPi;
    if (beyond_rad <= opening_rad) take(core::direction(bearing_rad));
  }
}

Sector::Sector(const core::Vec2& centre, double radius_m)
    : apex_(centre),
      radius_m_(radius_m),
      whole_(true),
      least_(centre - core::Vec2(radius_m, radius_m)),
      most_(centre + core::Vec2(radius_m, radius_m)) {}

Interval Sector::at_y(double y_m) const {
  const double y = y_m - apex_.y();
  const double square = radius_m_ * radius_m_ - y * y;
  if (square < 0.0) return {kInfinity, -kInfinity};
  const double half = std::sqrt(square);
  Interval interval{-half, half};
  if (!whole_) {
    cut(interval, right_, y);
    cut(interval, -left_, y);
  }
  return {apex_.x() + interval.from, apex_.x() + interval.to};
}

}  // namespace clew::map
