// SPDX-License-Identifier: Apache-2.0
#include "tune/tune_space.hpp"

#include <algorithm>
#include <map>

#include "bench/bench_plan.hpp"
#include "bench/suite.hpp"
#include "core/hash128.hpp"
#include "trap_worlds/generated_world.hpp"

namespace clew::tune {
namespace {

using core::Error;
using core::Result;

struct SuiteWorlds {
  std::vector<bench::BenchWorld> worlds;
  std::vector<std::uint64_t> seeds;
  std::uint64_t max_ticks = 0;
};

Result<SuiteWorlds> read_worlds(const std::string& name, const TuneRequest& request,
                                const std::vector<std::string>& fixed,
                                const runtime::ConfigPath& configs,
                                const std::vector<runtime::StageInfo>& stages) {
  const auto file = configs.find("suites", name);
  if (!file.ok()) return file.error();
  auto suite = bench::read_suite(*file, name);
  if (!suite.ok()) return suite.error();
  suite->variations.clear();
  suite->graphs = {request.graph};
  bench::BenchChanges changes;
  changes.with = request.with;
  changes.set = fixed;
  auto plan = bench::plan_bench(*suite, changes, configs, stages);
  if (!plan.ok()) return plan.error();
  return SuiteWorlds{std::move(plan->worlds), std::move(plan->seeds), suite->max_ticks};
}

Result<TuneWorld> read_world(const bench::BenchWorld& world, const runtime::ConfigPath& configs) {
  if (world.order) return TuneWorld{world.name, trap_worlds::generate_world(*world.order).text};
  const auto file = configs.find("worlds", world.name);
  if (!file.ok()) return file.error();
  return TuneWorld{world.name, file->text};
}

Result<void> add(const bench::BenchWorld& world, const runtime::ConfigPath& configs,
                 TuneWorlds& worlds) {
  auto read = read_world(world, configs);
  if (!read.ok()) return read.error();
  worlds.worlds.push_back(std::move(read).value());
  return {};
}

Result<void> add_all(const std::vector<bench::BenchWorld>& from, const runtime::ConfigPath& configs,
                     TuneWorlds& worlds) {
  for (const bench::BenchWorld& world : from) CLEW_RETURN_IF_ERROR(add(world, configs, worlds));
  return {};
}

/// The first, third, ... world of a family is for tuning, the others for validation.
Result<void> split(const SuiteWorlds& all, const runtime::ConfigPath& configs, TuneSpace& space) {
  std::map<std::string, std::size_t> seen;
  for (const bench::BenchWorld& world : all.worlds) {
    const bool is_kept = seen[world.family]++ % 2 == 1;
    CLEW_RETURN_IF_ERROR(add(world, configs, is_kept ? space.validation : space.tuning));
  }
  return {};
}

Result<void> check_is_another(const TuneSpace& space, const std::string& suite) {
  for (const TuneWorld& kept : space.validation.worlds) {
    const auto& tuned = space.tuning.worlds;
    const auto same = std::find_if(tuned.begin(), tuned.end(),
                                   [&](const TuneWorld& world) { return world.text == kept.text; });
    if (same == tuned.end()) continue;
    return Error{"'" + kept.name + "' is tuned in as well; validation needs other worlds", suite};
  }
  return {};
}

/// What the runs depend on besides worlds and searched settings: graph, robot, rule bases, ...
Result<std::string> digest_of_graph(const TuneSpace& space, const hunt::Workshop& workshop) {
  const TuneWorld& world = space.tuning.worlds.front();
  const auto plan = hunt::plan_case({space.graph, world.text, world.name, 1}, workshop);
  if (!plan.ok()) return plan.error();
  std::string content;
  for (const auto& [name, text] : plan->bundle) {
    if (name != "world.yaml") content += name + '\n' + text + '\n';
  }
  return core::hash128(content).hex();
}

Result<void> check_ends(const TuneSpace& space, const hunt::Workshop& workshop) {
  for (const double share : {0.0, 1.0}) {
    hunt::RunCase which{space.graph, space.tuning.worlds.front().text,
                        space.tuning.worlds.front().name, 1};
    for (const auto& range : space.ranges) which.graph.set.push_back(range.setting(share));
    const auto plan = hunt::plan_case(which, workshop);
    if (!plan.ok()) return plan.error();
  }
  return {};
}

}  // namespace

Result<TuneSpace> make_space(const TuneRequest& request, const runtime::ConfigPath& configs,
                             const std::vector<runtime::StageInfo>& stages) {
  auto settings = hunt::read_settings(request.set);
  if (!settings.ok()) return settings.error();
  if (settings->ranges.empty()) {
    return Error{"names no range; expected at least one STAGE...PARAM=LOW..HIGH", "--set"};
  }
  const auto all = read_worlds(request.suite, request, settings->fixed, configs, stages);
  if (!all.ok()) return all.error();
  TuneSpace space;
  space.graph = {request.graph, request.with, settings->fixed, request.robot,
                 request.max_ticks.value_or(all->max_ticks)};
  space.ranges = std::move(settings->ranges);
  space.tuning.seeds = space.validation.seeds = all->seeds;
  if (request.validate) {
    const auto others = read_worlds(*request.validate, request, space.graph.set, configs, stages);
    if (!others.ok()) return others.error();
    space.validation.seeds = others->seeds;
    CLEW_RETURN_IF_ERROR(add_all(all->worlds, configs, space.tuning));
    CLEW_RETURN_IF_ERROR(add_all(others->worlds, configs, space.validation));
    CLEW_RETURN_IF_ERROR(check_is_another(space, *request.validate));
  } else {
    CLEW_RETURN_IF_ERROR(split(*all, configs, space));
  }
  if (space.validation.worlds.empty()) {
    return Error{
        "has no family of two worlds or more, so none is left to validate on; --validate "
        "SUITE gives others",
        request.suite};
  }
  CLEW_RETURN_IF_ERROR(check_ends(space, {configs, stages}));
  auto digest = digest_of_graph(space, {configs, stages});
  if (!digest.ok()) return digest.error();
  space.graph_digest = std::move(digest).value();
  return space;
}

}  // namespace clew::tune
