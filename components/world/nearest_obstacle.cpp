// SPDX-License-Identifier: Apache-2.0
#include "world/nearest_obstacle.hpp"

#include <algorithm>
#include <limits>

#include "world/polygon.hpp"
#include "world/shapes.hpp"

namespace clew::world {
namespace {

double clearance(const World::Segment& segment, const Vec2& point) {
  return distance(point, nearest_point(segment, point));
}

double clearance(const World::Circle& circle, const Vec2& point) {
  return std::max(distance(point, circle.centre) - circle.radius_m, 0.0);
}

double clearance(const Polygon& polygon, const Vec2& point) {
  if (contains(polygon, point)) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (const World::Segment& edge : edges_of(polygon)) {
    least = std::min(least, clearance(edge, point));
  }
  return least;
}

double clearance(const MovingObstacle& moving, const Vec2& point) {
  return clearance(World::Circle{moving.position_at(0.0), moving.radius_m}, point);
}

double clearance(const MovingOutline& moving, const Vec2& point) {
  return clearance(moving.outline, point);
}

template <typename Shape>
std::size_t entry_of(const Shape&, std::size_t index) {
  return index;
}
std::size_t entry_of(const MovingObstacle& moving, std::size_t) { return moving.entry; }
std::size_t entry_of(const MovingOutline& moving, std::size_t) { return moving.entry; }

template <typename Shape>
void take_nearer(const std::vector<Shape>& shapes, const char* key, const Vec2& point,
                 NearestObstacle& nearest) {
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const double clearance_m = clearance(shapes[i], point);
    if (clearance_m < nearest.clearance_m) {
      nearest = {std::string(key) + '[' + std::to_string(entry_of(shapes[i], i)) + ']',
                 clearance_m};
    }
  }
}

}  // namespace

NearestObstacle nearest_obstacle(const WorldFile& world, const Vec2& point, Obstacles obstacles) {
  NearestObstacle nearest{"", std::numeric_limits<double>::infinity()};
  take_nearer(world.boundary(), "boundary", point, nearest);
  if (!nearest.name.empty()) nearest.name = "the boundary";
  take_nearer(world.walls, "walls", point, nearest);
  take_nearer(world.polygons, "polygons", point, nearest);
  take_nearer(world.circles, "circles", point, nearest);
  if (obstacles == Obstacles::kAllAtTime0) {
    take_nearer(world.moving, "moving", point, nearest);
    take_nearer(world.moving_outlines, "moving", point, nearest);
  }
  return nearest;
}

}  // namespace clew::world
