// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/geometry.hpp"
#include "world/bvh.hpp"
#include "world/world.hpp"

namespace clew::world {

inline Box box_of(const World::Segment& s) {
  return {std::min(s.a.x(), s.b.x()), std::min(s.a.y(), s.b.y()), std::max(s.a.x(), s.b.x()),
          std::max(s.a.y(), s.b.y())};
}

inline Box box_of(const World::Circle& c) {
  return {c.centre.x() - c.radius_m, c.centre.y() - c.radius_m, c.centre.x() + c.radius_m,
          c.centre.y() + c.radius_m};
}

inline double dot(const Vec2& a, const Vec2& b) { return a.x() * b.x() + a.y() * b.y(); }
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// A bound on a box that holds nothing of what is asked for.
inline constexpr double kFar = std::numeric_limits<double>::infinity();

/// Square of the least distance from a point to a box; 0 inside.
inline double squared_distance(const Vec2& point, const Box& box) {
  const double dx = std::max(std::max(box.min_x - point.x(), point.x() - box.max_x), 0.0);
  const double dy = std::max(std::max(box.min_y - point.y(), point.y() - box.max_y), 0.0);
  return dx * dx + dy * dy;
}

/// The point of a segment that is nearest to `point`. A segment may be a single point.
inline Vec2 nearest_point(const World::Segment& s, const Vec2& point) {
  const double ex = s.b.x() - s.a.x();
  const double ey = s.b.y() - s.a.y();
  const double along = (point.x() - s.a.x()) * ex + (point.y() - s.a.y()) * ey;
  if (!(along > 0.0)) return s.a;
  const double squared_length = ex * ex + ey * ey;
  if (along >= squared_length) return s.b;
  const double t = along / squared_length;
  return {s.a.x() + t * ex, s.a.y() + t * ey};
}

inline double distance(const Vec2& a, const Vec2& b) {
  return core::hypot(a.x() - b.x(), a.y() - b.y());
}

/// The point of a circle's line that is nearest to `point`; the centre for the centre itself.
inline Vec2 nearest_point(const World::Circle& circle, const Vec2& point) {
  const double length = distance(point, circle.centre);
  if (length == 0.0) return circle.centre;
  return circle.centre + (point - circle.centre) * (circle.radius_m / length);
}

/// Primitives of one kind with the tree over them, stored in its order.
template <typename Shape>
struct Indexed {
  Indexed() = default;
  explicit Indexed(const std::vector<Shape>& given) {
    std::vector<Box> boxes;
    boxes.reserve(given.size());
    for (const Shape& shape : given) boxes.push_back(box_of(shape));
    tree = Bvh(boxes);
    shapes.reserve(given.size());
    for (const std::uint32_t index : tree.order()) shapes.push_back(given[index]);
  }

  Bvh tree;
  std::vector<Shape> shapes;
};

}  // namespace clew::world
