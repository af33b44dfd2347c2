// SPDX-License-Identifier: Apache-2.0
#include "trap_worlds/world_draft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angle.hpp"

namespace clew::trap_worlds {
namespace {

double to_millimetres(double value_m) { return std::floor(value_m * 1000.0 + 0.5) / 1000.0; }

/// Without the sign of a zero, and without zeros at the end.
std::string number(double value) {
  std::string text = fmt::format("{:.3f}", value == 0.0 ? 0.0 : value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string point(const Vec2& p) { return '[' + number(p.x()) + ", " + number(p.y()) + ']'; }

struct Bounds {
  Vec2 min = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 max = -min;

  void take_in(const Vec2& p, double radius_m) {
    min = {std::min(min.x(), p.x() - radius_m), std::min(min.y(), p.y() - radius_m)};
    max = {std::max(max.x(), p.x() + radius_m), std::max(max.y(), p.y() + radius_m)};
  }
};

Bounds bounds_of(const WorldDraft& draft) {
  Bounds bounds;
  bounds.take_in(draft.start, 0.0);
  bounds.take_in(draft.target, 0.0);
  for (const auto& wall : draft.walls) {
    bounds.take_in(wall.a, 0.0);
    bounds.take_in(wall.b, 0.0);
  }
  for (const auto& circle : draft.circles) bounds.take_in(circle.centre, circle.radius_m);
  for (const auto& polygon : draft.polygons) {
    for (const Vec2& p : polygon) bounds.take_in(p, 0.0);
  }
  for (const auto& obstacle : draft.moving) {
    for (const auto& waypoint : obstacle.path) bounds.take_in(waypoint.position, obstacle.radius_m);
  }
  return bounds;
}

/// `key: [item, item, ...]`, an item a line; nothing without items.
template <typename Item, typename Text>
std::string list(const char* key, const std::vector<Item>& items, const Text& text_of) {
  if (items.empty()) return "";
  std::string text = fmt::format("{}: [", key);
  for (std::size_t i = 0; i < items.size(); ++i) {
    text += (i == 0 ? "\n  " : ",\n  ") + text_of(items[i]);
  }
  return text + "]\n";
}

std::string text_of_polygon(const std::vector<Vec2>& polygon) {
  std::string text;
  for (const Vec2& p : polygon) text += (text.empty() ? "" : ", ") + point(p);
  return '[' + text + ']';
}

std::string text_of_moving(const world::MovingObstacle& obstacle) {
  std::string path;
  for (const auto& waypoint : obstacle.path) {
    path += fmt::format("{}[{}, {}, {}]", path.empty() ? "" : ", ", number(waypoint.time_s),
                        number(waypoint.position.x()), number(waypoint.position.y()));
  }
  const Vec2& first = obstacle.path.front().position;
  return fmt::format("{{circle: [{}, {}, {}], path: [{}], loop: {}}}", number(first.x()),
                     number(first.y()), number(obstacle.radius_m), path, obstacle.loop);
}

}  // namespace

void WorldDraft::add_walls(const std::vector<Vec2>& points) {
  for (std::size_t i = 1; i < points.size(); ++i) walls.push_back({points[i - 1], points[i]});
}

void WorldDraft::say(const std::string& name, double length_m) {
  parameters += fmt::format("{}{} {:.2f} m", parameters.empty() ? "" : ", ", name, length_m);
}

void WorldDraft::say_time(const std::string& name, double time_s) {
  parameters += fmt::format("{}{} {:.1f} s", parameters.empty() ? "" : ", ", name, time_s);
}

void WorldDraft::say_count(const std::string& name, int count) {
  parameters += fmt::format("{}{} {}", parameters.empty() ? "" : ", ", count, name);
}

WorldDraft placed(const WorldDraft& draft, bool mirrored, double angle_rad) {
  const Vec2 turn = core::direction(angle_rad);
  const auto place = [&](Vec2& p) {
    const double x = mirrored ? -p.x() : p.x();
    p = {to_millimetres(turn.x() * x - turn.y() * p.y()),
         to_millimetres(turn.y() * x + turn.x() * p.y())};
  };
  WorldDraft done = draft;
  place(done.start);
  place(done.target);
  for (auto& wall : done.walls) {
    place(wall.a);
    place(wall.b);
  }
  for (auto& circle : done.circles) {
    place(circle.centre);
    circle.radius_m = to_millimetres(circle.radius_m);
  }
  for (auto& polygon : done.polygons) {
    for (Vec2& p : polygon) place(p);
  }
  for (auto& obstacle : done.moving) {
    obstacle.radius_m = to_millimetres(obstacle.radius_m);
    for (auto& waypoint : obstacle.path) {
      waypoint.time_s = to_millimetres(waypoint.time_s);
      place(waypoint.position);
    }
  }
  return done;
}

std::string world_text(const WorldDraft& draft, const WorldClaims& claims) {
  const Bounds bounds = bounds_of(draft);
  const double heading_rad = core::wrap_angle_rad(
      core::bearing_rad({draft.start.x(), draft.start.y(), 0.0}, draft.target) +
      draft.off_target_rad);
  std::string text =
      fmt::format("format: clew-world/1\nname: {}\nabout: \"{}\"\n", claims.name, claims.about);
  text +=
      fmt::format("bounds: [{}, {}, {}, {}]\n", number(bounds.min.x() - draft.border_m),
                  number(bounds.min.y() - draft.border_m), number(bounds.max.x() + draft.border_m),
                  number(bounds.max.y() + draft.border_m));
  text += list("walls", draft.walls, [](const world::World::Segment& wall) {
    return fmt::format("[{}, {}, {}, {}]", number(wall.a.x()), number(wall.a.y()),
                       number(wall.b.x()), number(wall.b.y()));
  });
  text += list("polygons", draft.polygons, text_of_polygon);
  text += list("circles", draft.circles, [](const world::World::Circle& circle) {
    return fmt::format("[{}, {}, {}]", number(circle.centre.x()), number(circle.centre.y()),
                       number(circle.radius_m));
  });
  text += list("moving", draft.moving, text_of_moving);
  text += fmt::format("start: [{}, {}, {}]\ntarget: {}\ntarget_radius: {}\nsolvable: {}\n",
                      number(draft.start.x()), number(draft.start.y()), number(heading_rad),
                      point(draft.target), draft.target_radius_m, claims.solvable);
  text += "shortest_path: " +
          (claims.gives_shortest_path ? number(claims.shortest_path_m) : std::string("null")) +
          '\n';
  return text;
}

}  // namespace clew::trap_worlds
