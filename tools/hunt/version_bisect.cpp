// SPDX-License-Identifier: Apache-2.0
#include "hunt/version_bisect.hpp"

#include <unistd.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace clew::hunt {
namespace {

using core::Result;

/// The stages, each of which may have its component by the other version.
std::vector<BisectDifference> stages_of(const runtime::RunPlan& plan) {
  std::vector<BisectDifference> stages;
  for (const runtime::GraphStage& stage : plan.graph.stages) {
    BisectDifference one;
    one.name = stage.info->name;
    stages.push_back(std::move(one));
  }
  std::sort(stages.begin(), stages.end(),
            [](const auto& x, const auto& y) { return x.name < y.name; });
  return stages;
}

/// A process has one program: which of its stages is another version could not be chosen.
Result<void> check_has_no_groups(const runtime::RunPlan& plan) {
  for (const runtime::GraphStage& stage : plan.graph.stages) {
    const runtime::Deployment& deployment = stage.deployment;
    if (deployment.group.empty()) continue;
    return deployment.group_place.error("stage '" + stage.info->name + "' shares the process '" +
                                        deployment.group +
                                        "', which has one version as a whole; --other-version "
                                        "takes graphs in which each stage has its own process");
  }
  return {};
}

}  // namespace

Result<BisectEnd> bisect_versions(const runtime::RunPlan& plan, const TwoVersions& versions,
                                  const std::optional<Property>& property) {
  if (access(versions.other.c_str(), X_OK) != 0) {
    return core::Error{"is no program that can be started", versions.other};
  }
  CLEW_RETURN_IF_ERROR(check_has_no_groups(plan));
  const std::vector<BisectDifference> stages = stages_of(plan);
  const auto run = [&](const std::vector<std::size_t>& changed, RunTrace& trace) {
    bridge::ProcessLayout layout;
    layout.program = versions.own;
    for (const std::size_t index : changed) {
      layout.stage_program[stages[index].name] = versions.other;
    }
    return run_as_processes(plan, layout, property ? &*property : nullptr, &trace);
  };
  const auto run_other = [&](RunTrace& trace) -> BisectProbe::Outcome {
    std::vector<std::size_t> all(stages.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    auto ran = run(all, trace);
    if (ran.ok()) return ran;
    return core::Error{"as the program of every component: " + ran.error().text(), versions.other};
  };
  return search_bisect({stages, run, run_other}, property);
}

}  // namespace clew::hunt
