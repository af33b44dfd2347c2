// SPDX-License-Identifier: Apache-2.0
#include "fleet/fleet_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/angle.hpp"
#include "core/yaml_fields.hpp"
#include "core/yaml_reader.hpp"
#include "domain/setup.hpp"
#include "world/goal_reader.hpp"

namespace clew::fleet {
namespace {

using core::Result;
using core::YamlNode;

constexpr char kFormat[] = "clew-fleet/1";
constexpr std::size_t kLongestName = 32;
constexpr double kLargest_m = 1e5;  // of a world file

runtime::Place place_of(const YamlNode& node) { return {node.file(), node.line(), node.column()}; }

Result<void> read_text(const YamlNode& map, const char* key, std::string& text) {
  const auto node = map.at(key);
  if (!node.ok()) return node.error();
  auto string = node->string();
  if (!string.ok()) return string.error();
  text = std::move(string).value();
  return {};
}

/// A name is that of a file and of a namespace.
Result<void> read_name(const YamlNode& map, const FleetFile& fleet, std::string& name) {
  CLEW_RETURN_IF_ERROR(read_text(map, "name", name));
  const bool allowed = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
  const bool letter = !name.empty() && name.front() >= 'a' && name.front() <= 'z';
  if (!allowed || !letter || name.size() > kLongestName) {
    return map.find("name")->error(
        fmt::format("found '{}'; allowed: a name of at most {} letters a-z, digits and _, which "
                    "begins with a letter",
                    name, kLongestName));
  }
  for (const RobotEntry& other : fleet.robots) {
    if (other.name != name) continue;
    return map.find("name")->error(
        fmt::format("'{}' is the name of robot {}, too; each robot has a name of its own", name,
                    &other - fleet.robots.data()));
  }
  return {};
}

Result<void> read_place(const YamlNode& map, RobotEntry& robot) {
  const auto start = map.at("start");
  if (!start.ok()) return start.error();
  const auto pose = start->numbers(3, "[x, y, heading]");
  if (!pose.ok()) return pose.error();
  robot.start = {(*pose)[0], (*pose)[1], core::wrap_angle_rad((*pose)[2])};
  robot.start_place = place_of(*start);

  const auto target = map.at("target");
  if (!target.ok()) return target.error();
  const auto items = target->items();
  if (!items.ok()) return items.error();
  const auto goal = world::read_goal(*target);
  if (!goal.ok()) return goal.error();
  robot.target = goal->place;
  robot.target_heading = goal->heading;
  robot.target_place = place_of(*target);
  robot.target_radius_m = goal->radius_m;
  if (!robot.target_radius_m) return {};
  if (*robot.target_radius_m > 0.0 && *robot.target_radius_m <= kLargest_m) return {};
  return (*items)[2].error(fmt::format("the radius is {}; allowed: above 0, at most {}",
                                       *robot.target_radius_m, kLargest_m));
}

Result<void> read_robot(const YamlNode& map, FleetFile& fleet) {
  CLEW_RETURN_IF_ERROR(map.check_keys({"name", "graph", "robot", "start", "target", "set"}));
  RobotEntry robot;
  robot.place = place_of(map);
  CLEW_RETURN_IF_ERROR(read_name(map, fleet, robot.name));
  CLEW_RETURN_IF_ERROR(read_text(map, "graph", robot.graph));
  if (map.find("robot")) CLEW_RETURN_IF_ERROR(read_text(map, "robot", robot.body.emplace()));
  CLEW_RETURN_IF_ERROR(read_place(map, robot));
  if (map.find("set")) CLEW_RETURN_IF_ERROR(core::read_names(map, "set", robot.set));
  fleet.robots.push_back(std::move(robot));
  return {};
}

}  // namespace

bool is_fleet(const core::Resource& file) {
  const auto root = YamlNode::parse(file.text, file.file);
  return root.ok() && root->find("robots").has_value();
}

Result<FleetFile> read_fleet_file(const core::Resource& file, const std::string& name) {
  const auto root = YamlNode::parse(file.text, file.file);
  if (!root.ok()) return root.error();
  if (const auto format = root->find("format");
      format && format->string().ok() && *format->string() == "clew-world/1") {
    return root->find("robots")->error(
        "a world has no robots; allowed: a file of the format clew-fleet/1 that names this world");
  }
  CLEW_RETURN_IF_ERROR(core::check_format(*root, kFormat));
  CLEW_RETURN_IF_ERROR(
      root->check_keys({"format", "about", "world", "seed", "max_ticks", "robots"}));
  FleetFile fleet;
  fleet.name = name;
  if (root->find("about")) CLEW_RETURN_IF_ERROR(read_text(*root, "about", fleet.about));
  CLEW_RETURN_IF_ERROR(read_text(*root, "world", fleet.world));
  fleet.world_place = place_of(*root->find("world"));
  constexpr std::int64_t kMost = 1'000'000'000'000;
  if (root->find("seed")) {
    CLEW_RETURN_IF_ERROR(core::read_count(*root, "seed", 0, kMost, fleet.seed.emplace()));
  }
  if (root->find("max_ticks")) {
    CLEW_RETURN_IF_ERROR(core::read_count(*root, "max_ticks", 0, kMost, fleet.max_ticks.emplace()));
  }
  const auto robots = root->at("robots");
  if (!robots.ok()) return robots.error();
  const auto items = robots->items();
  if (!items.ok()) return items.error();
  fleet.robots_place = place_of(*robots);
  if (items->empty() || items->size() > domain::kMostRobots) {
    return robots->error(
        fmt::format("found {} robots; allowed: 1 to {}", items->size(), domain::kMostRobots));
  }
  for (const YamlNode& item : *items) CLEW_RETURN_IF_ERROR(read_robot(item, fleet));
  return fleet;
}

}  // namespace clew::fleet
