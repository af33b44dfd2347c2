// SPDX-License-Identifier: Apache-2.0
#include "fleet/robot_world.hpp"

#include <fmt/format.h>

#include <iterator>

namespace clew::fleet {
namespace {

using core::Vec2;
using world::World;

/// Appends `key: [item, ...]`, an item a line; nothing without items.
template <typename Items, typename Append>
void append_list(std::string& text, const char* key, const Items& items, const Append& append) {
  if (items.empty()) return;
  text += key;
  text += ": [";
  bool first = true;
  for (const auto& item : items) {
    text += first ? "\n  " : ",\n  ";
    first = false;
    append(item);
  }
  text += "]\n";
}

void append_path(std::string& text, double radius_m,
                 const std::vector<world::MovingObstacle::Waypoint>& path) {
  const Vec2& first = path.front().position;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "{{circle: [{}, {}, {}], path: [", first.x(), first.y(), radius_m);
  bool begun = false;
  for (const auto& point : path) {
    fmt::format_to(out, "{}[{}, {}, {}]", begun ? ", " : "", point.time_s, point.position.x(),
                   point.position.y());
    begun = true;
  }
  text += ']';
}

}  // namespace

std::string robot_world_text(const World& world, const core::Pose2& start,
                             const world::Waypoint& target, const std::vector<OtherRobot>& others) {
  std::string text = fmt::format("format: clew-world/1\nname: {}\nbounds: [{}, {}, {}, {}]\n",
                                 world.name(), world.bounds_min().x(), world.bounds_min().y(),
                                 world.bounds_max().x(), world.bounds_max().y());
  auto out = std::back_inserter(text);
  append_list(text, "walls", world.walls(), [&](const World::Segment& wall) {
    fmt::format_to(out, "[{}, {}, {}, {}]", wall.a.x(), wall.a.y(), wall.b.x(), wall.b.y());
  });
  append_list(text, "polygons", world.polygons(), [&](const std::vector<Vec2>& polygon) {
    const char* before = "[";
    for (const Vec2& point : polygon) {
      fmt::format_to(out, "{}[{}, {}]", before, point.x(), point.y());
      before = ", ";
    }
    text += ']';
  });
  append_list(text, "circles", world.circles(), [&](const World::Circle& circle) {
    fmt::format_to(out, "[{}, {}, {}]", circle.centre.x(), circle.centre.y(), circle.radius_m);
  });
  struct Item {
    double radius_m;
    const std::vector<world::MovingObstacle::Waypoint>* path;
    const char* end;
  };
  std::vector<Item> moving;
  for (const world::MovingObstacle& obstacle : world.moving()) {
    const char* end = obstacle.loop ? ", loop: true}" : obstacle.jumps ? ", jumps: true}" : "}";
    moving.push_back({obstacle.radius_m, &obstacle.path, end});
  }
  for (const OtherRobot& other : others) {
    moving.push_back({other.radius_m, &other.path, ", jumps: true}"});
  }
  append_list(text, "moving", moving, [&](const Item& item) {
    append_path(text, item.radius_m, *item.path);
    text += item.end;
  });
  fmt::format_to(out, "start: [{}, {}, {}]\ntarget: [{}, {}]\ntarget_radius: {}\n", start.x_m,
                 start.y_m, start.heading_rad, target.place.x(), target.place.y(), target.radius_m);
  return text;
}

}  // namespace clew::fleet
