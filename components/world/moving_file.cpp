// SPDX-License-Identifier: Apache-2.0
#include "world/moving_file.hpp"

#include <fmt/format.h>

#include <utility>

#include "world/moving_shape.hpp"
#include "world/world_values.hpp"

namespace clew::world {
namespace {

using core::Result;
using core::YamlNode;

/// Times rise from 0: `before` is the last one, null at the beginning of `what`.
Result<void> check_time(const YamlNode& item, double time_s, const double* before,
                        const char* what) {
  if (before == nullptr && time_s != 0.0) {
    return item.error(fmt::format("the {} begins at {} s; it must begin at 0", what, time_s));
  }
  if (before != nullptr && time_s < *before + kLeastStep_s) {
    return item.error(fmt::format("the time {} s follows {} s; times must rise, by {} s at least",
                                  time_s, *before, kLeastStep_s));
  }
  return {};
}

Result<void> read(const YamlNode& node, std::vector<MovingObstacle::Waypoint>& path) {
  const auto items = node.items();
  if (!items.ok() || items->empty()) {
    return node.error("found " + node.found() + ", expected at least one point [[t, x, y], ...]");
  }
  for (const YamlNode& item : *items) {
    const auto numbers = read_numbers(item, 3, "[t, x, y]");
    if (!numbers.ok()) return numbers.error();
    const double time_s = (*numbers)[0];
    CLEW_RETURN_IF_ERROR(
        check_time(item, time_s, path.empty() ? nullptr : &path.back().time_s, "path"));
    path.push_back({time_s, {(*numbers)[1], (*numbers)[2]}});
  }
  return {};
}

Result<void> read(const YamlNode& node, std::vector<Turn>& turns) {
  const auto items = node.items();
  if (!items.ok() || items->empty()) {
    return node.error("found " + node.found() +
                      ", expected at least one angle in rad, [[t, angle], ...]");
  }
  for (const YamlNode& item : *items) {
    const auto numbers = read_numbers(item, 2, "[t, angle]");
    if (!numbers.ok()) return numbers.error();
    const double time_s = (*numbers)[0];
    CLEW_RETURN_IF_ERROR(
        check_time(item, time_s, turns.empty() ? nullptr : &turns.back().time_s, "turning"));
    turns.push_back({time_s, (*numbers)[1]});
  }
  return {};
}

/// As read_required, of the lists that only this file reads.
template <typename List>
Result<void> read_at(const YamlNode& map, const char* key, List& list) {
  const auto node = map.at(key);
  if (!node.ok()) return node.error();
  return read(*node, list);
}

Result<void> read_moving_circle(const YamlNode& node, MovingObstacle& moving) {
  CLEW_RETURN_IF_ERROR(node.check_keys({"circle", "path", "loop", "jumps"}));
  World::Circle circle;
  CLEW_RETURN_IF_ERROR(read_required(node, "circle", circle));
  CLEW_RETURN_IF_ERROR(read_at(node, "path", moving.path));
  CLEW_RETURN_IF_ERROR(read_optional(node, "loop", moving.loop));
  CLEW_RETURN_IF_ERROR(read_optional(node, "jumps", moving.jumps));
  if (moving.loop && moving.jumps) {
    return node.find("jumps")->error("an obstacle that jumps cannot loop; allowed: one of the two");
  }
  moving.radius_m = circle.radius_m;
  const Vec2& first = moving.path.front().position;
  if (circle.centre == first) return {};
  return node.error(
      fmt::format("the circle is at [{}, {}], but its path begins at [{}, {}]; they must agree",
                  circle.centre.x(), circle.centre.y(), first.x(), first.y()));
}

Result<std::vector<MovingObstacle>> read_moving_polygon(const YamlNode& node, ShapeRoom& room,
                                                        Polygon& outline) {
  CLEW_RETURN_IF_ERROR(node.check_keys({"polygon", "path", "loop"}));
  MovingPolygon moving;
  CLEW_RETURN_IF_ERROR(read_required(node, "polygon", moving.outline));
  CLEW_RETURN_IF_ERROR(read_at(node, "path", moving.path));
  CLEW_RETURN_IF_ERROR(read_optional(node, "loop", moving.loop));
  const Vec2& corner = moving.outline.front();
  const Vec2& first = moving.path.front().position;
  if (corner == first) {
    outline = moving.outline;
    return discs_of(moving, room);
  }
  return node.error(
      fmt::format("the polygon's first point is [{}, {}], but its path begins at [{}, {}]; they "
                  "must agree",
                  corner.x(), corner.y(), first.x(), first.y()));
}

Result<std::vector<MovingObstacle>> read_door(const YamlNode& node, ShapeRoom& room) {
  CLEW_RETURN_IF_ERROR(node.check_keys({"door", "turns", "loop"}));
  Door door;
  const auto leaf = node.at("door");
  if (!leaf.ok()) return leaf.error();
  const auto numbers = read_numbers(*leaf, 3, "[x, y, length]");
  if (!numbers.ok()) return numbers.error();
  door.hinge = {(*numbers)[0], (*numbers)[1]};
  door.length_m = (*numbers)[2];
  if (!(door.length_m > 0.0)) {
    return leaf->error(fmt::format("the length is {}; it must be above 0", door.length_m));
  }
  CLEW_RETURN_IF_ERROR(read_at(node, "turns", door.turns));
  CLEW_RETURN_IF_ERROR(read_optional(node, "loop", door.loop));
  return discs_of(door, room);
}

/// A circle is one moving disc; a polygon and a door are rows of them. Only a polygon has an
/// outline.
Result<std::vector<MovingObstacle>> read_moving(const YamlNode& node, ShapeRoom& room,
                                                Polygon& outline) {
  if (node.find("polygon")) return read_moving_polygon(node, room, outline);
  if (node.find("door")) return read_door(node, room);
  MovingObstacle circle;
  CLEW_RETURN_IF_ERROR(read_moving_circle(node, circle));
  return std::vector<MovingObstacle>{std::move(circle)};
}

}  // namespace

Result<void> read_all_moving(const YamlNode& root, WorldFile& world) {
  const auto node = root.find("moving");
  if (!node) return {};
  const auto items = node->items();
  if (!items.ok()) return items.error();
  ShapeRoom room;
  for (const YamlNode& item : *items) {
    const auto entry = static_cast<std::uint32_t>(&item - items->data());
    Polygon outline;
    auto discs = read_moving(item, room, outline);
    if (!discs.ok() && discs.error().file.empty()) return item.error(discs.error().message);
    if (!discs.ok()) return discs.error();
    for (MovingObstacle& disc : *discs) {
      disc.entry = entry;
      world.moving.push_back(std::move(disc));
    }
    if (!outline.empty()) world.moving_outlines.push_back({std::move(outline), entry});
  }
  return {};
}

}  // namespace clew::world
