// SPDX-License-Identifier: Apache-2.0
#include "world/polygon.hpp"

#include <limits>

namespace clew::world {
namespace {

constexpr double kOutside = std::numeric_limits<double>::infinity();

// Whether the ray from `point` along the x axis crosses the segment; each end counts once in a
// chain of segments.
bool ray_crosses(const World::Segment& s, const Vec2& point) {
  if ((s.a.y() > point.y()) == (s.b.y() > point.y())) return false;
  const double u = (point.y() - s.a.y()) / (s.b.y() - s.a.y());
  return point.x() < s.a.x() + u * (s.b.x() - s.a.x());
}

bool inside_edges(const Indexed<World::Segment>& edges, const Vec2& point) {
  bool inside = false;
  edges.tree.visit_nearest_first(
      [&](const Box& box) {
        return box.min_y <= point.y() && point.y() <= box.max_y && point.x() <= box.max_x
                   ? 0.0
                   : kOutside;
      },
      kOutside, [&](std::uint32_t i) { inside ^= ray_crosses(edges.shapes[i], point); });
  return inside;
}

// Twice the signed area of a triangle: positive if c lies left of the way from a to b.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool box_contains(const World::Segment& s, const Vec2& p) {
  const Box box = box_of(s);
  return box.min_x <= p.x() && p.x() <= box.max_x && box.min_y <= p.y() && p.y() <= box.max_y;
}

bool segments_meet(const World::Segment& s, const World::Segment& t) {
  const double ta = turn(s.a, s.b, t.a);
  const double tb = turn(s.a, s.b, t.b);
  const double sa = turn(t.a, t.b, s.a);
  const double sb = turn(t.a, t.b, s.b);
  if (((ta > 0.0 && tb < 0.0) || (ta < 0.0 && tb > 0.0)) &&
      ((sa > 0.0 && sb < 0.0) || (sa < 0.0 && sb > 0.0))) {
    return true;
  }
  return (ta == 0.0 && box_contains(s, t.a)) || (tb == 0.0 && box_contains(s, t.b)) ||
         (sa == 0.0 && box_contains(t, s.a)) || (sb == 0.0 && box_contains(t, s.b));
}

// Whether b -> c runs back over a -> b.
bool folds_back(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 in = b - a;
  const Vec2 out = c - b;
  return turn(a, b, c) == 0.0 && in.x() * out.x() + in.y() * out.y() <= 0.0;
}

}  // namespace

std::vector<World::Segment> edges_of(const Polygon& polygon) {
  std::vector<World::Segment> edges;
  edges.reserve(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    edges.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
  }
  return edges;
}

bool contains(const Polygon& polygon, const Vec2& point) {
  bool inside = false;
  for (const World::Segment& edge : edges_of(polygon)) inside ^= ray_crosses(edge, point);
  return inside;
}

std::optional<std::pair<std::size_t, std::size_t>> find_crossing(const Polygon& polygon) {
  const std::size_t n = polygon.size();
  const Indexed<World::Segment> edges(edges_of(polygon));
  std::optional<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t i = 0; i < n && !found; ++i) {
    const std::size_t next = (i + 1) % n;
    if (folds_back(polygon[i], polygon[next], polygon[(i + 2) % n])) return {{i, next}};
    const World::Segment edge{polygon[i], polygon[next]};
    const Box box = box_of(edge);
    edges.tree.visit_nearest_first(
        [&](const Box& other) {
          return other.min_x <= box.max_x && box.min_x <= other.max_x && other.min_y <= box.max_y &&
                         box.min_y <= other.max_y
                     ? 0.0
                     : kOutside;
        },
        kOutside,
        [&](std::uint32_t place) {
          const std::size_t j = edges.tree.order()[place];
          const bool neighbours = j == i || j == next || (j + 1) % n == i;
          if (!neighbours && segments_meet(edge, edges.shapes[place])) found = {i, j};
        });
  }
  return found;
}

FilledAreas::FilledAreas(const std::vector<Polygon>& polygons) {
  std::vector<Box> boxes;
  for (const Polygon& polygon : polygons) {
    Box box{polygon[0].x(), polygon[0].y(), polygon[0].x(), polygon[0].y()};
    for (const Vec2& p : polygon) {
      box = {std::min(box.min_x, p.x()), std::min(box.min_y, p.y()), std::max(box.max_x, p.x()),
             std::max(box.max_y, p.y())};
    }
    boxes.push_back(box);
  }
  tree_ = Bvh(boxes);
  for (const std::uint32_t index : tree_.order()) areas_.emplace_back(edges_of(polygons[index]));
}

bool FilledAreas::contains(const Vec2& point) const {
  double limit = kOutside;
  tree_.visit_nearest_first(
      [&](const Box& box) {
        return box.min_x <= point.x() && point.x() <= box.max_x && box.min_y <= point.y() &&
                       point.y() <= box.max_y
                   ? 0.0
                   : kOutside;
      },
      limit,
      [&](std::uint32_t i) {
        if (inside_edges(areas_[i], point)) limit = 0.0;
      });
  return limit == 0.0;
}

}  // namespace clew::world
