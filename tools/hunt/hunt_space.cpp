// SPDX-License-Identifier: Apache-2.0
#include "hunt/hunt_space.hpp"

#include <algorithm>

#include "bench/suite.hpp"
#include "core/nearest_name.hpp"
#include "trap_worlds/families.hpp"
#include "world/world_file.hpp"

namespace clew::hunt {
namespace {

using core::Result;

/// Shipped worlds that say they can be solved.
Result<std::vector<std::string>> solvable_worlds(const runtime::ConfigPath& configs) {
  std::vector<std::string> solvable;
  for (const std::string& name : configs.names("worlds")) {
    const auto file = configs.find("worlds", name);
    if (!file.ok()) return file.error();
    const auto world = world::read_world_file(file->text, file->file);
    if (!world.ok()) return world.error();
    if (world->solvable.value_or(false)) solvable.push_back(name);
  }
  return solvable;
}

Result<void> add_families(const std::vector<std::string>& names, HuntSpace& space) {
  const auto& all = trap_worlds::families();
  std::vector<std::string> known;
  for (const auto& family : all) known.push_back(family.name);
  for (const std::string& name : names) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) {
      return core::Error{core::unknown_name("family", name, known), "--family"};
    }
    space.families.push_back(&all[static_cast<std::size_t>(found - known.begin())]);
  }
  return {};
}

/// The suite's worlds, or those of the request as a suite has them.
Result<bench::Suite> suite_of(const HuntRequest& request, const std::vector<std::string>& worlds,
                              const runtime::ConfigPath& configs) {
  bench::Suite suite;
  suite.name = "--world";
  if (request.suite) {
    const auto file = configs.find("suites", *request.suite);
    if (!file.ok()) return file.error();
    auto read = bench::read_suite(*file, *request.suite);
    if (!read.ok()) return read.error();
    suite = std::move(read).value();
    suite.variations.clear();
    suite.seeds = {1};
  }
  suite.graphs = {request.graph};
  if (!worlds.empty()) suite.worlds.emplace_back("world", worlds);
  return suite;
}

Result<void> add_worlds(const HuntRequest& request, const std::vector<std::string>& worlds,
                        const runtime::ConfigPath& configs,
                        const std::vector<runtime::StageInfo>& stages, HuntSpace& space) {
  if (!request.suite && worlds.empty()) return {};
  const auto suite = suite_of(request, worlds, configs);
  if (!suite.ok()) return suite.error();
  bench::BenchChanges changes;
  changes.with = request.with;
  changes.set = space.graph.set;
  auto plan = bench::plan_bench(*suite, changes, configs, stages);
  if (!plan.ok()) return plan.error();
  space.worlds = std::move(plan->worlds);
  return {};
}

/// The graph in the first world, at both ends of all ranges; its robot's radius.
Result<void> check_ends(HuntSpace& space, const Workshop& workshop) {
  for (const double share : {0.0, 1.0}) {
    Candidate candidate;
    candidate.parameters.assign(space.ranges.size(), share);
    const auto which = realise(candidate, space, workshop.configs);
    if (!which.ok()) return which.error();
    const auto plan = plan_case(*which, workshop);
    if (!plan.ok()) return plan.error();
    space.robot_radius_m = plan->setup.behaviour.robot.radius_m;
  }
  return {};
}

}  // namespace

Result<HuntSpace> make_space(const HuntRequest& request, const runtime::ConfigPath& configs,
                             const std::vector<runtime::StageInfo>& stages) {
  HuntSpace space;
  auto settings = read_settings(request.set);
  if (!settings.ok()) return settings.error();
  space.graph = {request.graph, request.with, std::move(settings->fixed), request.robot,
                 request.max_ticks.value_or(kHuntTicks)};
  space.ranges = std::move(settings->ranges);
  space.moves_start = request.moves_start;
  std::vector<std::string> worlds = request.worlds;
  std::vector<std::string> families = request.families;
  if (!request.suite && worlds.empty() && families.empty()) {
    auto solvable = solvable_worlds(configs);
    if (!solvable.ok()) return solvable.error();
    worlds = std::move(solvable).value();
    for (const auto& family : trap_worlds::families()) {
      if (family.solvable && trap_worlds::is_of_traps(family)) families.push_back(family.name);
    }
  }
  CLEW_RETURN_IF_ERROR(add_families(families, space));
  CLEW_RETURN_IF_ERROR(add_worlds(request, worlds, configs, stages, space));
  CLEW_RETURN_IF_ERROR(check_ends(space, {configs, stages}));
  return space;
}

}  // namespace clew::hunt
