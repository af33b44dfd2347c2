// SPDX-License-Identifier: Apache-2.0
#include "bench/world_bench.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "bench/barn.hpp"
#include "clew/run_output.hpp"
#include "recorder/recording_sink.hpp"
#include "recording/output_file.hpp"
#include "replay/branch.hpp"
#include "run/composed_run.hpp"
#include "supervisor/process_run.hpp"
#include "world/world.hpp"

namespace clew::bench {
namespace {

using core::Result;
using nlohmann::ordered_json;

std::vector<DetectorScore> detectors_of(const runtime::Graph& graph) {
  std::vector<DetectorScore> detectors;
  const runtime::GraphStage* recover = graph.find("recover");
  if (recover == nullptr) return detectors;
  const auto add = [&](const char* part, bool shadow) {
    const auto choices = recover->config.parts.find(part);
    if (choices == recover->config.parts.end()) return;
    for (const auto& choice : choices->second) {
      if (choice.name != "none") detectors.push_back({choice.name, shadow, 0, 0, 0, {}, {}});
    }
  };
  add("detector", false);
  add("shadow", true);
  return detectors;
}

ordered_json to_json(const TrapJudge& judge) {
  ordered_json detectors = ordered_json::array();
  for (const DetectorScore& score : judge.scores()) {
    ordered_json one = {{"rule", score.rule}, {"shadow", score.shadow}, {"alarms", score.alarms}};
    if (judge.has_truth()) {
      one["false_alarms"] = score.false_alarms;
      one["noticed"] = score.noticed;
      one["delays_s"] = score.delays_s;
      one["delays_m"] = score.delays_m;
    }
    detectors.push_back(std::move(one));
  }
  return detectors;
}

ordered_json to_json(const BarnScore& barn) {
  return {{"arrived", barn.arrived},
          {"optimal_time_s", barn.optimal_time_s},
          {"score", barn.score},
          {"score_2022", barn.score_2022}};
}

/// Whether the run ended as it should: at the target, or with `unreachable` where it is. None for
/// `unreachable` where the world does not say.
std::optional<bool> is_success(const std::string& outcome, const world::World& world) {
  if (world.solvable()) return outcome == (*world.solvable() ? "reached" : "unreachable");
  if (outcome == "unreachable") return std::nullopt;
  return outcome == "reached";
}

/// A third-party component is a process, and so are the others with it.
bool needs_processes(const runtime::Graph& graph) {
  return std::any_of(graph.stages.begin(), graph.stages.end(),
                     [](const auto& stage) { return !stage.deployment.exec.empty(); });
}

Result<bridge::RunReport> run_processes(const runtime::RunPlan& run, const std::string& path) {
  bridge::ProcessLayout layout;
  layout.program = "/proc/self/exe";
  CLEW_RETURN_IF_ERROR(bridge::mcap::OutputFile::reserve(path, true));
  return bridge::run_processes(run, layout, {{path, bridge::describe_run(run), 0.0}}, {}, {});
}

/// Runs as processes, recorded in passing: the judge looks at the samples afterwards.
Result<bridge::RunReport> run_processes(const runtime::RunPlan& run, TrapJudge& judge) {
  const std::string path =
      (std::filesystem::temp_directory_path() / fmt::format("clew-bench-{}.mcap", ::getpid()))
          .string();
  auto report = run_processes(run, path);
  if (report.ok()) {
    const auto recording = bridge::RunRecording::open(path);
    if (!recording.ok()) return recording.error();
    CLEW_RETURN_IF_ERROR(bridge::copy_samples_before(*recording, UINT64_MAX, judge));
  }
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  return report;
}

}  // namespace

Result<runtime::RunPlan> WorldBench::prepare(const Variant& variant, std::uint64_t seed) const {
  runtime::GraphOverrides overrides = variant.overrides;
  overrides.world = world_.name;
  overrides.seed = seed;
  return runtime::prepare_run(variant.graph, overrides, source_, stages_);
}

const world_analysis::TrapMap* WorldBench::traps(const runtime::RunPlan& run) {
  if (!grid_) {
    surveyed_ = run.setup.world;
    const auto settled_s = world_analysis::settled_time_s(*surveyed_);
    if (!settled_s) return nullptr;
    grid_ = std::make_unique<world_analysis::ClearanceGrid>(*surveyed_, *settled_s);
  }
  // Minima shallower than the robot is wide are none.
  const double radius_m = run.setup.behaviour.robot.radius_m;
  return &traps_by_radius_.try_emplace(radius_m, *grid_, radius_m, 2.0 * radius_m).first->second;
}

Result<std::optional<std::string>> WorldBench::run(const Variant& variant, std::uint64_t seed) {
  const auto run = prepare(variant, seed);
  if (!run.ok()) return run.error();
  const world::World& world = *run->setup.world;
  TrapJudge judge(traps(*run), run->setup.behaviour.robot.radius_m, detectors_of(run->graph));
  const bool as_processes = needs_processes(run->graph);
  const auto report = as_processes
                          ? run_processes(*run, judge)
                          : bridge::run_composed(*run, bridge::ComposedLayout{}, &judge, {});
  if (!report.ok()) return report.error();
  if (report->interrupted_by != 0) return std::optional<std::string>();

  ordered_json line;
  line["graph"] = variant.graph;
  line["variant"] = variant.text();
  line["world"] = world_.name;
  line["family"] = world_.family;
  const tools::RunFacts facts =
      as_processes ? tools::RunFacts{"processes", bridge::ProcessLayout{}.middleware, ""}
                   : tools::RunFacts{"composed", "inprocess", ""};
  auto as_run = ordered_json::parse(tools::report_json(*report, *run, facts));
  // As the suite names them, which may be by a path.
  as_run["graph"] = line["graph"];
  as_run["world"] = line["world"];
  line.update(as_run);
  const auto success = is_success(as_run["outcome"], world);
  line["success"] = success ? ordered_json(*success) : ordered_json(nullptr);
  line["solvable"] = world.solvable() ? ordered_json(*world.solvable()) : ordered_json(nullptr);
  line["depth_ranges"] =
      source_.depth_ranges() ? ordered_json(*source_.depth_ranges()) : ordered_json(nullptr);
  line["captures"] = judge.has_truth() ? ordered_json(judge.captures()) : ordered_json(nullptr);
  line["held_at_end"] = judge.has_truth() ? ordered_json(judge.is_held()) : ordered_json(nullptr);
  line["detectors"] = to_json(judge);
  if (world_.barn_path_m > 0.0) {
    line["barn"] = to_json(
        barn_score(as_run["outcome"] == "reached", as_run["sim_time_s"], world_.barn_path_m));
  }
  return std::optional<std::string>(line.dump());
}

Result<void> WorldBench::record(const Variant& variant, std::uint64_t seed,
                                const std::string& path) {
  const auto run = prepare(variant, seed);
  if (!run.ok()) return run.error();
  if (needs_processes(run->graph)) {
    const auto report = run_processes(*run, path);
    return report.ok() ? Result<void>() : Result<void>(report.error());
  }
  auto recording = bridge::RecordingSink::create(*run, path, true);
  if (!recording.ok()) return recording.error();
  const auto report = bridge::run_composed(*run, bridge::ComposedLayout{}, recording->get(), {});
  if (!report.ok()) return report.error();
  const bridge::RecordingAccount closed = (*recording)->close({});
  if (!closed.failure.empty()) return core::Error{closed.failure, {}, 0, 0};
  return {};
}

}  // namespace clew::bench
