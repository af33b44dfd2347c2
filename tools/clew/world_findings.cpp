// SPDX-License-Identifier: Apache-2.0
#include "clew/world_findings.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "log/log.hpp"
#include "runtime/run_plan.hpp"
#include "world_analysis/reachability.hpp"
#include "world_analysis/shortest_path.hpp"

namespace clew::tools {

using core::Result;
using nlohmann::ordered_json;

namespace {

/// A way counts only with this much room beside the robot: a gap that fits in theory is none.
constexpr double kMargin_m = 0.02;
/// With more places than that the answer takes more than a few seconds.
constexpr double kManyPlaces = 5e6;

void tell_long_wait(const world::World& world) {
  const double places = world_analysis::lattice_nodes(world);
  if (places < kManyPlaces) return;
  logs::info("{} has {:.0f} million places to look at, a few seconds a million", world.name(),
             1e-6 * places);
}

/// Of a mission of several way-points, each leg from place to place. Its traps are others on each
/// leg, and are not looked for.
WorldFindings find_out_legs(const WorldSubject& subject) {
  WorldFindings findings;
  const auto time_s = world_analysis::settled_time_s(subject.world);
  if (!time_s || !world_analysis::fits_lattice(subject.world)) {
    findings.undecided = time_s ? "it is too large" : "something moves for ever";
    return findings;
  }
  tell_long_wait(subject.world);
  const world_analysis::ClearanceGrid grid(subject.world, *time_s);
  double length_m = 0.0;
  bool has_path = true;
  std::size_t number = 0;
  for (const world_analysis::Leg& leg : world_analysis::legs_of(subject.world)) {
    ++number;
    const auto solvable = world_analysis::is_solvable(grid, leg, subject.radius_m, kMargin_m);
    if (solvable == world_analysis::Solvable::kNo) {
      findings.solvable = false;
      findings.undecided.clear();
      return findings;
    }
    if (solvable == world_analysis::Solvable::kUndecided) {
      findings.undecided = fmt::format(
          "the only ways to way-point {} lead through gaps about as wide as the robot", number);
      continue;
    }
    const auto path = world_analysis::shortest_path(grid, leg, subject.radius_m);
    has_path = has_path && path;
    if (path) length_m += path->length_m;
  }
  if (!findings.undecided.empty()) return findings;
  findings.solvable = true;
  if (has_path) findings.shortest_path_m = length_m;
  return findings;
}

}  // namespace

Result<WorldSubject> read_subject(const std::string& world_name, const std::string& robot_name) {
  const auto configs = runtime::ConfigPath::from_environment();
  auto file = configs.find("worlds", world_name);
  if (!file.ok()) return file.error();
  auto world = world::World::parse(file->text, file->file);
  if (!world.ok()) return world.error();
  const auto robot_file = configs.find("robots", robot_name);
  if (!robot_file.ok()) return robot_file.error();
  const auto robot = runtime::read_robot(*robot_file, robot_name);
  if (!robot.ok()) return robot.error();
  CLEW_RETURN_IF_ERROR(world->check_robot_fits(robot->radius_m));
  return WorldSubject{std::move(file).value(), std::move(world).value(), robot->radius_m};
}

WorldFindings find_out(const WorldSubject& subject, WithSeverity with) {
  if (subject.world.waypoints().size() > 1 && with == WithSeverity::kNo) {
    return find_out_legs(subject);
  }
  WorldFindings findings;
  const auto time_s = world_analysis::surveyed_time_s(subject.world);
  if (!time_s.ok()) {
    findings.undecided = time_s.error().message;
    return findings;
  }
  findings.surveyed = true;
  tell_long_wait(subject.world);
  const world_analysis::ClearanceGrid grid(subject.world, *time_s);
  const auto solvable = world_analysis::is_solvable(grid, subject.radius_m, kMargin_m);
  if (solvable == world_analysis::Solvable::kUndecided) {
    const bool is_covered = subject.world.clearance_m(subject.world.start().position(),
                                                      subject.radius_m, *time_s) < subject.radius_m;
    findings.undecided = is_covered ? "what moves comes to rest on the start"
                                    : "the only ways lead through gaps about as wide as the robot";
  } else {
    findings.solvable = solvable == world_analysis::Solvable::kYes;
  }
  if (findings.solvable == true) {
    const auto path = world_analysis::shortest_path(grid, subject.radius_m);
    if (path) findings.shortest_path_m = path->length_m;
  }
  const world_analysis::TrapMap map(grid, subject.radius_m, 2.0 * subject.radius_m);
  findings.traps = world_analysis::traps_within_reach(map);
  if (with == WithSeverity::kYes) {
    findings.severity = world_analysis::severity_of(grid, map, subject.radius_m);
  }
  return findings;
}

ordered_json to_json(const WorldSubject& subject, const WorldFindings& findings) {
  ordered_json json = {{"world", subject.world.name()}, {"robot_radius_m", subject.radius_m}};
  json["solvable"] = findings.solvable ? ordered_json(*findings.solvable) : ordered_json(nullptr);
  json["shortest_path_m"] =
      findings.shortest_path_m ? ordered_json(*findings.shortest_path_m) : ordered_json(nullptr);
  json["traps"] = ordered_json::array();
  for (const world_analysis::Trap& trap : findings.traps) {
    // Without a way out a trap has no depth.
    json["traps"].push_back(
        {{"x_m", trap.place.x()},
         {"y_m", trap.place.y()},
         {"depth_m", std::isfinite(trap.depth_m) ? ordered_json(trap.depth_m) : nullptr}});
  }
  json["undecided"] = findings.undecided;
  return json;
}

}  // namespace clew::tools
