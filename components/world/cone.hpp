// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry.hpp"
#include "world/shapes.hpp"
#include "world/world.hpp"

namespace clew::world {

/// All points within half_angle_rad of a bearing from an apex, as the intersection of three half
/// planes through the apex: left of the right edge, right of the left edge, and before the apex.
/// The third matters only for a half angle of 0, a ray, whose two edges are one line.
///
/// What two segments share they clip alike, bit for bit, so a ray never slips between them.
class Cone {
 public:
  Cone(const Vec2& apex, const ConeDirection& direction) : apex_(apex), axis_(direction.axis) {
    const double c = direction.half_angle.x();
    const double s = direction.half_angle.y();
    left_ = {axis_.x() * c - axis_.y() * s, axis_.y() * c + axis_.x() * s};
    right_ = {axis_.x() * c + axis_.y() * s, axis_.y() * c - axis_.x() * s};
  }

  const Vec2& apex() const { return apex_; }

  bool contains(const Vec2& point) const {
    const Vec2 p{point.x() - apex_.x(), point.y() - apex_.y()};
    return cross(right_, p) >= 0.0 && cross(p, left_) >= 0.0 && dot(axis_, p) >= 0.0;
  }

  /// A lower limit of the squared distance from the apex to what lies in both the cone and the box;
  /// infinity if nothing does, or nothing nearer than the squared distance `limit`.
  double bound(const Box& box, double limit) const;

  /// Square of the least distance from the apex to the part of a segment inside the cone; infinity
  /// if there is none, and possibly if none is nearer than the squared distance `limit`.
  double squared_distance(const World::Segment& segment, double limit) const;

  /// The same for a filled circle; 0 from inside it.
  double squared_distance(const World::Circle& circle, double limit) const;

 private:
  static constexpr double kNothing = std::numeric_limits<double>::infinity();

  static double dot(const Vec2& a, const Vec2& b) { return a.x() * b.x() + a.y() * b.y(); }

  // Largest value of normal . p over the box from `min` to `max`.
  static double farthest(double normal_x, double normal_y, const Vec2& min, const Vec2& max) {
    return std::max(normal_x * min.x(), normal_x * max.x()) +
           std::max(normal_y * min.y(), normal_y * max.y());
  }
  // Cuts the range [from, to] of a segment's parameter to where a linear function is not negative
  // that is `at_a` at 0 and `at_b` at 1; false if it is negative at both.
  static bool clip(double at_a, double at_b, double& from, double& to) {
    if (at_a < 0.0) {
      if (at_b < 0.0) return false;
      from = std::max(from, at_a / (at_a - at_b));
    } else if (at_b < 0.0) {
      to = std::min(to, at_a / (at_a - at_b));
    }
    return true;
  }
  // Distance along a ray from the apex to a circle that does not contain it; infinity if it misses.
  static double ray_to_circle(const Vec2& direction, const Vec2& centre, double power) {
    const double along = dot(direction, centre);
    const double discriminant = along * along - power;
    return along > 0.0 && discriminant >= 0.0 ? power / (along + std::sqrt(discriminant))
                                              : kNothing;
  }

  Vec2 apex_;
  Vec2 axis_;
  Vec2 left_;
  Vec2 right_;
};

inline double Cone::bound(const Box& box, double limit) const {
  const Vec2 min{box.min_x - apex_.x(), box.min_y - apex_.y()};
  const Vec2 max{box.max_x - apex_.x(), box.max_y - apex_.y()};
  const double dx = std::max(std::max(min.x(), -max.x()), 0.0);
  const double dy = std::max(std::max(min.y(), -max.y()), 0.0);
  const double squared_distance = dx * dx + dy * dy;
  if (!(squared_distance < limit) || farthest(-right_.y(), right_.x(), min, max) < 0.0 ||
      farthest(left_.y(), -left_.x(), min, max) < 0.0 ||
      farthest(axis_.x(), axis_.y(), min, max) < 0.0) {
    return kNothing;
  }
  return squared_distance;
}

inline double Cone::squared_distance(const World::Segment& segment, double limit) const {
  const Vec2 a{segment.a.x() - apex_.x(), segment.a.y() - apex_.y()};
  const Vec2 b{segment.b.x() - apex_.x(), segment.b.y() - apex_.y()};
  const Vec2 edge{b.x() - a.x(), b.y() - a.y()};
  const double squared_length = dot(edge, edge);
  const double area = cross(a, b);
  // The line through the segment is too far away; the factor leaves doubtful cases to the rest.
  if (area * area > limit * squared_length * (1.0 + 1e-12)) return kNothing;
  double from = 0.0;
  double to = 1.0;
  if (!clip(cross(right_, a), cross(right_, b), from, to)) return kNothing;
  if (!clip(cross(a, left_), cross(b, left_), from, to)) return kNothing;
  if (!clip(dot(axis_, a), dot(axis_, b), from, to)) return kNothing;
  if (from > to) return kNothing;
  const double foot = squared_length > 0.0 ? -dot(a, edge) / squared_length : 0.0;
  const double t = std::min(std::max(foot, from), to);
  const Vec2 nearest{a.x() + t * edge.x(), a.y() + t * edge.y()};
  return dot(nearest, nearest);
}

// The disc and the cone are convex. If the point of the disc that is nearest to the apex is outside
// the cone, the nearest one inside lies on one of the cone's edges.
inline double Cone::squared_distance(const World::Circle& circle, double limit) const {
  const Vec2 centre{circle.centre.x() - apex_.x(), circle.centre.y() - apex_.y()};
  const double squared_centre = dot(centre, centre);
  // |centre|^2 > 2 (limit + radius^2) >= (sqrt(limit) + radius)^2: too far away.
  if (squared_centre > 2.0 * (limit + circle.radius_m * circle.radius_m)) return kNothing;
  const double from_right = cross(right_, centre);
  const double from_left = cross(centre, left_);
  if (from_right < -circle.radius_m || from_left < -circle.radius_m) return kNothing;
  const double power = squared_centre - circle.radius_m * circle.radius_m;
  if (power <= 0.0) return 0.0;
  double distance = kNothing;
  if (from_right >= 0.0 && from_left >= 0.0 && dot(axis_, centre) >= 0.0) {
    distance = power / (std::sqrt(squared_centre) + circle.radius_m);
  } else {
    distance = std::min(ray_to_circle(left_, centre, power), ray_to_circle(right_, centre, power));
  }
  return distance * distance;
}

}  // namespace clew::world
