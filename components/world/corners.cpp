// SPDX-License-Identifier: Apache-2.0
#include "world/corners.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clew::world {
namespace {

// World files round to millimetres, so a wall may end this far beside the one it ends on.
constexpr double kJoin_m = 1e-3;
// Where two segments go on straight, or lie on each other, there is no corner: sine of the angle.
constexpr double kStraight = 1e-3;

// An arm is a part of a segment that leaves a point.
struct Arm {
  Vec2 direction;
  double angle_rad;
};

void add_arm(std::vector<Arm>& arms, const Vec2& from, const Vec2& to) {
  const double length = distance(from, to);
  if (length <= kJoin_m) return;
  const Vec2 direction = (to - from) / length;
  arms.push_back({direction, core::atan2(direction.y(), direction.x())});
}

// All arms at a point, counter-clockwise.
std::vector<Arm> arms_at(const Indexed<World::Segment>& segments,
                         const std::vector<World::Segment>& boundary, const Vec2& point) {
  std::vector<Arm> arms;
  const auto look = [&](const World::Segment& s) {
    if (distance(point, nearest_point(s, point)) > kJoin_m) return;
    add_arm(arms, point, s.a);
    add_arm(arms, point, s.b);
  };
  segments.tree.visit_nearest_first(
      [&](const Box& box) {
        return squared_distance(point, box) <= kJoin_m * kJoin_m ? 0.0 : kFar;
      },
      kFar, [&](std::uint32_t i) { look(segments.shapes[i]); });
  for (const World::Segment& side : boundary) look(side);
  std::sort(arms.begin(), arms.end(),
            [](const Arm& a, const Arm& b) { return a.angle_rad < b.angle_rad; });
  return arms;
}

bool filled(const Vec2& point, const FilledAreas& polygons, const Indexed<World::Circle>& circles) {
  double limit = kFar;
  circles.tree.visit_nearest_first(
      [&](const Box& box) { return squared_distance(point, box) > 0.0 ? kFar : 0.0; }, limit,
      [&](std::uint32_t i) {
        const World::Circle& circle = circles.shapes[i];
        if (distance(point, circle.centre) <= circle.radius_m) limit = 0.0;
      });
  return limit == 0.0 || polygons.contains(point);
}

std::vector<Vec2> distinct_ends(const Indexed<World::Segment>& segments,
                                const std::vector<World::Segment>& boundary) {
  std::vector<Vec2> ends;
  ends.reserve(2 * (segments.shapes.size() + boundary.size()));
  for (const auto* shapes : {&segments.shapes, &boundary}) {
    for (const World::Segment& s : *shapes) {
      ends.push_back(s.a);
      ends.push_back(s.b);
    }
  }
  std::sort(ends.begin(), ends.end(), [](const Vec2& a, const Vec2& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

}  // namespace

std::vector<Corner> find_corners(const Indexed<World::Segment>& segments,
                                 const std::vector<World::Segment>& boundary,
                                 const FilledAreas& polygons,
                                 const Indexed<World::Circle>& circles) {
  std::vector<Corner> corners;
  for (const Vec2& point : distinct_ends(segments, boundary)) {
    const std::vector<Arm> arms = arms_at(segments, boundary, point);
    for (std::size_t i = 0; arms.size() > 1 && i < arms.size(); ++i) {
      const Corner corner{point, arms[i].direction, arms[(i + 1) % arms.size()].direction};
      if (cross(corner.right, corner.left) <= kStraight) continue;  // none, or on the far side
      const Vec2 inside = point + kJoin_m * (corner.right + corner.left);
      if (!filled(inside, polygons, circles)) corners.push_back(corner);
    }
  }
  return corners;
}

std::optional<double> nearest_corner_m(const Indexed<Corner>& corners, const Cone& cone,
                                       double max_distance_m) {
  const double limit = max_distance_m * max_distance_m;
  double nearest = limit;
  corners.tree.visit_nearest_first([&](const Box& box) { return cone.bound(box, nearest); },
                                   nearest,
                                   [&](std::uint32_t i) {
                                     const Corner& corner = corners.shapes[i];
                                     if (!corner.faces(cone.apex())) return;
                                     if (!cone.contains(corner.point)) return;
                                     const double dx = corner.point.x() - cone.apex().x();
                                     const double dy = corner.point.y() - cone.apex().y();
                                     nearest = std::min(nearest, dx * dx + dy * dy);
                                   });
  if (!(nearest < limit)) return std::nullopt;
  return std::sqrt(nearest);
}

}  // namespace clew::world
