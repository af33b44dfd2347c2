// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/angle.hpp"
#include "core/math.hpp"

namespace clew::core {

/// A point or vector in the plane, metres; x forward or right, y left or up (REP 103).
using Vec2 = Eigen::Vector2d;

/// A pose in the plane. Heading counter-clockwise from the x axis, in (-pi, pi].
struct Pose2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;

  Vec2 position() const { return {x_m, y_m}; }
};

inline bool operator==(const Pose2& a, const Pose2& b) {
  return a.x_m == b.x_m && a.y_m == b.y_m && a.heading_rad == b.heading_rad;
}
inline bool operator!=(const Pose2& a, const Pose2& b) { return !(a == b); }

template <typename Visitor>
void visit_fields(Visitor& visit, Pose2& p) {
  visit(p.x_m, p.y_m, p.heading_rad);
}

/// The unit vector at `angle_rad` from the x axis.
inline Vec2 direction(double angle_rad) { return {cos(angle_rad), sin(angle_rad)}; }

/// Length of v; Eigen's norm() without its vectorised summation order.
inline double length(const Vec2& v) { return hypot(v.x(), v.y()); }

/// Bearing of `point` from `pose`, counter-clockwise from its heading, in (-pi, pi]; 0 if it is the
/// pose's own position.
inline double bearing_rad(const Pose2& pose, const Vec2& point) {
  const double dx = point.x() - pose.x_m;
  const double dy = point.y() - pose.y_m;
  if (dx == 0.0 && dy == 0.0) return 0.0;
  return wrap_angle_rad(atan2(dy, dx) - pose.heading_rad);
}

inline double distance_m(const Pose2& pose, const Vec2& point) {
  return hypot(point.x() - pose.x_m, point.y() - pose.y_m);
}

}  // namespace clew::core
