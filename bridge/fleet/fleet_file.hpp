// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry.hpp"
#include "core/resources.hpp"
#include "core/result.hpp"
#include "runtime/graph.hpp"
#include "world/world.hpp"

namespace clew::fleet {

/// A robot of a fleet, as its file says.
struct RobotEntry {
  std::string name;
  std::string graph;
  std::optional<std::string> body;  ///< a robot file, in the place of the graph's
  core::Pose2 start;
  core::Vec2 target = core::Vec2::Zero();
  std::optional<double> target_radius_m;  ///< none: the world's
  std::optional<world::GoalHeading> target_heading;
  std::vector<std::string> set;  ///< as `clew run --set`
  runtime::Place place;
  runtime::Place start_place;
  runtime::Place target_place;
};

/// Several robots in one world: `clew-fleet/1`.
struct FleetFile {
  std::string name;
  std::string about;
  std::string world;
  std::optional<std::uint64_t> seed;  ///< none: each graph's
  std::optional<std::uint64_t> max_ticks;
  std::vector<RobotEntry> robots;  ///< in the order of their indices
  runtime::Place world_place;
  runtime::Place robots_place;
};

/// Whether the file is one of a fleet, good or not: it lists robots.
bool is_fleet(const core::Resource& file);

/// Reads a fleet. Refused, with the place and what is allowed: unknown or missing keys, names that
/// are no file's name or are taken, fewer than 1 or more than domain::kMostRobots robots, and
/// values that are none.
core::Result<FleetFile> read_fleet_file(const core::Resource& file, const std::string& name);

}  // namespace clew::fleet
