// SPDX-License-Identifier: Apache-2.0
#include "train/scaled_world.hpp"

#include <fmt/format.h>

#include "world/goal_reader.hpp"

namespace clew::train {
namespace {

using core::Vec2;

std::string point(const Vec2& p, double scale) {
  return fmt::format("[{}, {}]", p.x() * scale, p.y() * scale);
}

template <typename Items, typename Text>
std::string list(const Items& items, const Text& text) {
  std::string joined;
  for (const auto& item : items) joined += (joined.empty() ? "" : ", ") + text(item);
  return '[' + joined + ']';
}

}  // namespace

std::string scaled_world_yaml(const world::World& world, double scale) {
  using World = world::World;
  const auto wall = [scale](const World::Segment& s) {
    return fmt::format("[{}, {}, {}, {}]", s.a.x() * scale, s.a.y() * scale, s.b.x() * scale,
                       s.b.y() * scale);
  };
  const auto corner = [scale](const Vec2& p) { return point(p, scale); };
  const auto polygon = [&](const std::vector<Vec2>& corners) { return list(corners, corner); };
  const auto circle = [scale](const World::Circle& c) {
    return fmt::format("[{}, {}, {}]", c.centre.x() * scale, c.centre.y() * scale,
                       c.radius_m * scale);
  };
  std::string yaml = "format: clew-world/1\nname: " + world.name() + '\n';
  yaml += fmt::format("bounds: [{}, {}, {}, {}]\n", world.bounds_min().x() * scale,
                      world.bounds_min().y() * scale, world.bounds_max().x() * scale,
                      world.bounds_max().y() * scale);
  yaml += "walls: " + list(world.walls(), wall) + '\n';
  yaml += "polygons: " + list(world.polygons(), polygon) + '\n';
  yaml += "circles: " + list(world.circles(), circle) + '\n';
  yaml += fmt::format("start: [{}, {}, {}]\n", world.start().x_m * scale, world.start().y_m * scale,
                      world.start().heading_rad);
  yaml += "target: " + point(world.target(), scale) + '\n';
  return yaml + fmt::format("target_radius: {}\n", world.target_radius_m()) +
         world::target_heading_yaml(world.target_heading());
}

}  // namespace clew::train
