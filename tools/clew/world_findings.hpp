// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/resources.hpp"
#include "core/result.hpp"
#include "world/world.hpp"
#include "world_analysis/severity.hpp"

namespace clew::tools {

/// A world and the robot that it is looked at for.
struct WorldSubject {
  core::Resource file;
  world::World world;
  double radius_m = 0.0;
};

/// Reads a world and a robot, by names or paths. Refused: a robot that does not fit at the start.
core::Result<WorldSubject> read_subject(const std::string& world, const std::string& robot);

/// What is true of a world and a robot, obstacles standing where they come to rest.
struct WorldFindings {
  bool surveyed = false;         ///< else nothing is known, and `undecided` says why
  std::optional<bool> solvable;  ///< none: not surveyed, or only gaps just as wide as the robot
  std::optional<double> shortest_path_m;
  /// No shallower than the robot is wide, and within the robot's reach.
  std::vector<world_analysis::Trap> traps;
  std::optional<world_analysis::Severity> severity;  ///< if asked for, and surveyed
  std::string undecided;                             ///< why; empty if it is decided
};

enum class WithSeverity { kNo, kYes };

WorldFindings find_out(const WorldSubject& subject, WithSeverity with = WithSeverity::kNo);

nlohmann::ordered_json to_json(const WorldSubject& subject, const WorldFindings& findings);

}  // namespace clew::tools
