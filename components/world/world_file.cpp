// SPDX-License-Identifier: Apache-2.0
#include "world/world_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/yaml_fields.hpp"
#include "core/yaml_reader.hpp"
#include "world/moving_file.hpp"
#include "world/nearest_obstacle.hpp"
#include "world/world_values.hpp"

namespace clew::world {
namespace {

using core::Result;
using core::YamlNode;

constexpr const char* kFormat = "clew-world/1";

Result<void> read_head(const YamlNode& root, WorldFile& world) {
  if (const auto image = root.at("image"); image.ok() && !root.at("format").ok()) {
    return image->error("is a map of ROS, not a world: 'clew world import' makes a world of it");
  }
  CLEW_RETURN_IF_ERROR(core::check_format(root, kFormat));
  CLEW_RETURN_IF_ERROR(
      root.check_keys({"format", "name", "about", "bounds", "walls", "polygons", "circles",
                       "moving", "subgoals", "start", "waypoints", "target", "target_radius",
                       "target_heading", "solvable", "shortest_path"}));
  CLEW_RETURN_IF_ERROR(read_required(root, "name", world.name));
  const bool allowed = std::all_of(world.name.begin(), world.name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
  if (world.name.empty() || !allowed) {
    return root.at("name")->error("found '" + world.name + "', expected a name of a-z, 0-9 and -");
  }
  return read_optional(root, "about", world.about);
}

Result<void> read_bounds(const YamlNode& root, WorldFile& world) {
  const auto node = root.at("bounds");
  if (!node.ok()) return node.error();
  const auto numbers = read_numbers(*node, 4, "[xmin, ymin, xmax, ymax]");
  if (!numbers.ok()) return numbers.error();
  world.bounds_min = {(*numbers)[0], (*numbers)[1]};
  world.bounds_max = {(*numbers)[2], (*numbers)[3]};
  const Vec2 size = world.bounds_max - world.bounds_min;
  if (size.x() > 0.0 && size.y() > 0.0) return {};
  return node->error(
      fmt::format("the bounds are empty, {} m by {} m; [xmin, ymin, xmax, ymax] "
                  "must have xmin < xmax and ymin < ymax",
                  size.x(), size.y()));
}

// A point that the robot is to be at lies within the bounds and in no obstacle: else, why not.
std::string why_not_free(const char* what, const Vec2& point, const WorldFile& world,
                         Obstacles obstacles) {
  const Vec2& min = world.bounds_min;
  const Vec2& max = world.bounds_max;
  if (!(min.x() < point.x() && point.x() < max.x() && min.y() < point.y() && point.y() < max.y())) {
    return fmt::format("the {} [{}, {}] is not within the bounds [{}, {}, {}, {}]", what, point.x(),
                       point.y(), min.x(), min.y(), max.x(), max.y());
  }
  const NearestObstacle nearest = nearest_obstacle(world, point, obstacles);
  if (nearest.clearance_m > 0.0) return {};
  return fmt::format("the {} [{}, {}] is inside or on an obstacle, {}", what, point.x(), point.y(),
                     nearest.name);
}

Result<void> check_free(const YamlNode& node, const char* what, const Vec2& point,
                        const WorldFile& world, Obstacles obstacles) {
  std::string why_not = why_not_free(what, point, world, obstacles);
  if (why_not.empty()) return {};
  return node.error(std::move(why_not));
}

Result<void> read_waypoints(const YamlNode& root, WorldFile& world) {
  const auto node = root.find("waypoints");
  if (!node) return {};
  const auto items = node->items();
  if (!items.ok()) return items.error();
  if (items->size() >= kMostGoals) {
    return node->error(fmt::format("found {} way-points; allowed: {} before the target",
                                   items->size(), kMostGoals - 1));
  }
  for (const YamlNode& item : *items) {
    Waypoint waypoint{Vec2::Zero(), world.target_radius_m, std::nullopt};
    CLEW_RETURN_IF_ERROR(read(item, waypoint));
    CLEW_RETURN_IF_ERROR(check_free(item, "way-point", waypoint.place, world, Obstacles::kStatic));
    world.waypoints.push_back(waypoint);
  }
  return {};
}

// What moves may leave a target or subgoal again; only the start must be free of it.
Result<void> read_places(const YamlNode& root, WorldFile& world) {
  CLEW_RETURN_IF_ERROR(read_required(root, "start", world.start));
  const YamlNode start = *root.at("start");
  world.start_place = start.error("");
  CLEW_RETURN_IF_ERROR(
      check_free(start, "start", world.start.position(), world, Obstacles::kAllAtTime0));
  CLEW_RETURN_IF_ERROR(read_required(root, "target", world.target));
  CLEW_RETURN_IF_ERROR(
      check_free(*root.at("target"), "target", world.target, world, Obstacles::kStatic));
  CLEW_RETURN_IF_ERROR(read_required(root, "target_radius", world.target_radius_m));
  if (const auto node = root.find("target_heading")) {
    CLEW_RETURN_IF_ERROR(read(*node, world.target_heading.emplace()));
  }
  CLEW_RETURN_IF_ERROR(read_waypoints(root, world));
  CLEW_RETURN_IF_ERROR(read_list(root, "subgoals", world.subgoals));
  for (std::size_t i = 0; i < world.subgoals.size(); ++i) {
    CLEW_RETURN_IF_ERROR(check_free((*root.at("subgoals")->items())[i], "subgoal",
                                    world.subgoals[i], world, Obstacles::kStatic));
  }
  return {};
}

Result<void> read_claims(const YamlNode& root, WorldFile& world) {
  if (const auto node = root.find("solvable")) {
    CLEW_RETURN_IF_ERROR(read(*node, world.solvable.emplace()));
  }
  const auto node = root.find("shortest_path");
  if (!node || node->kind() == core::YamlKind::kNull) return {};
  if (!world.waypoints.empty()) {
    return node->error(
        "shortest_path is the length of the way to the target, and there are waypoints before it; "
        "allowed: one of the two");
  }
  return read(*node, world.shortest_path_m.emplace());
}

}  // namespace

std::vector<World::Segment> WorldFile::boundary() const {
  const Vec2 lower_right{bounds_max.x(), bounds_min.y()};
  const Vec2 upper_left{bounds_min.x(), bounds_max.y()};
  return {{bounds_min, lower_right},
          {lower_right, bounds_max},
          {bounds_max, upper_left},
          {upper_left, bounds_min}};
}

core::Result<void> set_goals(const Goals& goals, WorldFile& world) {
  world.waypoints.clear();
  for (const Goal& goal : goals) {
    const std::string name =
        goals.size() == 1 ? "goal" : fmt::format("way-point {}", world.waypoints.size() + 1);
    std::string why_not = why_not_free(name.c_str(), goal.place, world, Obstacles::kStatic);
    if (goal.radius_m && !(*goal.radius_m > 0.0)) {
      why_not = fmt::format("the {}'s radius is {} m; it must be positive", name, *goal.radius_m);
    }
    if (!why_not.empty()) return core::Error{std::move(why_not)};
    world.waypoints.push_back(
        {goal.place, goal.radius_m.value_or(world.target_radius_m), goal.heading});
  }
  world.has_mission = !goals.empty();
  if (world.has_mission) {
    world.target = world.waypoints.back().place;
    world.target_radius_m = world.waypoints.back().radius_m;
    world.target_heading = world.waypoints.back().heading;
    world.waypoints.pop_back();
  }
  world.subgoals.clear();
  world.solvable.reset();
  world.shortest_path_m.reset();
  return {};
}

core::Result<WorldFile> read_world_file(std::string_view yaml, const std::string& file) {
  const auto root = YamlNode::parse(yaml, file);
  if (!root.ok()) return root.error();
  WorldFile world;
  CLEW_RETURN_IF_ERROR(read_head(*root, world));
  CLEW_RETURN_IF_ERROR(read_bounds(*root, world));
  CLEW_RETURN_IF_ERROR(read_list(*root, "walls", world.walls));
  CLEW_RETURN_IF_ERROR(read_list(*root, "polygons", world.polygons));
  CLEW_RETURN_IF_ERROR(read_list(*root, "circles", world.circles));
  CLEW_RETURN_IF_ERROR(read_all_moving(*root, world));
  CLEW_RETURN_IF_ERROR(read_places(*root, world));
  CLEW_RETURN_IF_ERROR(read_claims(*root, world));
  return world;
}

}  // namespace clew::world
