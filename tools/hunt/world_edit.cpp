// SPDX-License-Identifier: Apache-2.0
#include "hunt/world_edit.hpp"

#include <fmt/format.h>

#include <limits>
#include <vector>

#include "core/angle.hpp"
#include "core/quoted.hpp"
#include "world/goal_reader.hpp"
#include "world_analysis/clearance_grid.hpp"
#include "world_analysis/reachability.hpp"
#include "world_analysis/shortest_path.hpp"

namespace clew::hunt {
namespace {

using core::Vec2;
using world::MovingObstacle;
using world::World;

/// A way counts only with this much room beside the robot.
constexpr double kMargin_m = 0.02;
/// A start this near to the target's disc tells nothing.
constexpr double kLeastWay_m = 0.5;

std::string text_of(const Vec2& point) { return fmt::format("[{}, {}]", point.x(), point.y()); }
std::string text_of(const World::Segment& wall) {
  return fmt::format("[{}, {}, {}, {}]", wall.a.x(), wall.a.y(), wall.b.x(), wall.b.y());
}
std::string text_of(const World::Circle& circle) {
  return fmt::format("[{}, {}, {}]", circle.centre.x(), circle.centre.y(), circle.radius_m);
}
std::string text_of(const world::Polygon& polygon) {
  std::string text;
  for (const Vec2& corner : polygon) text += (text.empty() ? "[" : ", ") + text_of(corner);
  return text + ']';
}
std::string text_of(const MovingObstacle& moving) {
  std::string path;
  for (const auto& point : moving.path) {
    path += fmt::format("{}[{}, {}, {}]", path.empty() ? "" : ", ", point.time_s,
                        point.position.x(), point.position.y());
  }
  return fmt::format("{{circle: {}, path: [{}], {}: {}}}",
                     text_of(World::Circle{moving.path.front().position, moving.radius_m}), path,
                     moving.jumps ? "jumps" : "loop", moving.jumps || moving.loop);
}

std::string text_of(const world::Waypoint& waypoint) {
  return '[' + world::goal_numbers({waypoint.place, waypoint.radius_m, waypoint.heading}, ", ") +
         ']';
}

template <typename Item>
std::string list_text(const char* key, const std::vector<Item>& items) {
  if (items.empty()) return {};
  std::string lines;
  for (const Item& item : items) lines += (lines.empty() ? "\n  " : ",\n  ") + text_of(item);
  return std::string(key) + ": [" + lines + "]\n";
}

}  // namespace

std::string world_text(const world::WorldFile& world) {
  std::string text = "format: clew-world/1\nname: " + world.name + '\n';
  if (!world.about.empty()) text += "about: " + core::yaml_quoted(world.about) + '\n';
  text += "bounds: " + text_of(World::Segment{world.bounds_min, world.bounds_max}) + '\n';
  text += list_text("walls", world.walls) + list_text("polygons", world.polygons) +
          list_text("circles", world.circles) + list_text("moving", world.moving) +
          list_text("subgoals", world.subgoals) + list_text("waypoints", world.waypoints);
  text += fmt::format("start: [{}, {}, {}]\n", world.start.x_m, world.start.y_m,
                      world.start.heading_rad);
  text += "target: " + text_of(world.target) + '\n';
  text += fmt::format("target_radius: {}\n", world.target_radius_m);
  text += world::target_heading_yaml(world.target_heading);
  if (world.solvable) text += fmt::format("solvable: {}\n", *world.solvable);
  if (world.shortest_path_m) text += fmt::format("shortest_path: {}\n", *world.shortest_path_m);
  return text;
}

core::Result<void> settle_claims(world::WorldFile& world, double robot_radius_m) {
  world.solvable.reset();
  world.shortest_path_m.reset();
  const auto parsed = World::parse(world_text(world), world.name);
  if (!parsed.ok()) return parsed.error();
  CLEW_RETURN_IF_ERROR(parsed->check_robot_fits(robot_radius_m));
  const auto time_s = world_analysis::surveyed_time_s(*parsed);
  if (!time_s.ok()) return {};
  const world_analysis::ClearanceGrid grid(*parsed, *time_s);
  switch (world_analysis::is_solvable(grid, robot_radius_m, kMargin_m)) {
    case world_analysis::Solvable::kUndecided:
      return {};
    case world_analysis::Solvable::kNo:
      world.solvable = false;
      return {};
    case world_analysis::Solvable::kYes:
      world.solvable = true;
  }
  if (!world.moving.empty() || !world.waypoints.empty()) return {};
  const auto path = world_analysis::shortest_path(grid, robot_radius_m);
  if (path && path->length_m > 0.0) world.shortest_path_m = path->length_m;
  return {};
}

std::optional<core::Pose2> start_at(const World& world, double robot_radius_m,
                                    const std::array<double, 3>& shares) {
  if (!world_analysis::fits_lattice(world)) return std::nullopt;
  const double time_s = world_analysis::settled_time_s(world).value_or(0.0);
  const world_analysis::ClearanceGrid grid(world, time_s);
  const double radius_m = robot_radius_m + kMargin_m;
  const Vec2 size = world.bounds_max() - world.bounds_min();
  const Vec2 wanted{world.bounds_min().x() + shares[0] * size.x(),
                    world.bounds_min().y() + shares[1] * size.y()};
  std::vector<bool> seen(grid.size());
  std::vector<std::size_t> open;
  const auto enter = [&](std::size_t node) {
    if (seen[node] || grid.clearance_m(node) < radius_m) return;
    seen[node] = true;
    open.push_back(node);
  };
  const Vec2 own = world.start().position();
  const auto begin = [&](std::size_t node) {
    if (grid.is_way_free(own, grid.position(node), robot_radius_m)) enter(node);
  };
  const std::size_t middle = grid.nearest(own);
  begin(middle);
  grid.visit_around(middle, 2, begin);
  std::optional<Vec2> best;
  double best_m = std::numeric_limits<double>::infinity();
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    const Vec2 place = grid.position(node);
    const double distance_m = core::length(place - wanted);
    if (distance_m < best_m &&
        core::length(place - world.target()) > world.target_radius_m() + kLeastWay_m &&
        world.clearance_m(place, radius_m, 0.0) >= radius_m) {
      best = place;
      best_m = distance_m;
    }
    grid.visit_around(node, 1, [&](std::size_t next) {
      if (!seen[next] && grid.is_way_free(node, next, radius_m)) enter(next);
    });
  }
  if (!best) return std::nullopt;
  return core::Pose2{best->x(), best->y(), core::wrap_angle_rad(2.0 * core::kPi * shares[2])};
}

}  // namespace clew::hunt
