// SPDX-License-Identifier: Apache-2.0
#include "bench/world_bench.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "bench/barn.hpp"
#include "bench/coverage.hpp"
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

/// How hard a world is, with lengths in ranges of the robot's sensor; all null where it is unknown.
/// `made_with`: the depth that a generated world was ordered with.
ordered_json severity_json(const world_analysis::Severity* severity, double range_m,
                           const std::optional<double>& made_with) {
  const auto or_null = [](const std::optional<double>& value) {
    return value && std::isfinite(*value) ? ordered_json(*value) : ordered_json(nullptr);
  };
  std::optional<double> deepest_ranges;
  std::optional<double> backtrack_ranges;
  if (severity != nullptr) {
    deepest_ranges = severity->deepest_m / range_m;
    if (severity->backtrack_m) backtrack_ranges = *severity->backtrack_m / range_m;
  }
  ordered_json json;
  json["depth_ranges"] = or_null(made_with ? made_with : deepest_ranges);
  json["severity_ranges"] = or_null(deepest_ranges);
  json["nested_pockets"] = severity ? ordered_json(severity->nested_pockets) : nullptr;
  json["necessary_backtrack_m"] = or_null(severity ? severity->backtrack_m : std::nullopt);
  json["necessary_backtrack_ranges"] = or_null(backtrack_ranges);
  json["bug1_bound_m"] = severity ? ordered_json(severity->bug.bug1_m) : nullptr;
  json["bug2_bound_m"] = severity ? ordered_json(severity->bug.bug2_m) : nullptr;
  return json;
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

/// Runs it as processes if it needs them, with a recording.
Result<bridge::RunReport> run_recorded(const runtime::RunPlan& run, const std::string& path) {
  if (needs_processes(run.graph)) {
    bridge::ProcessLayout layout;
    layout.program = "/proc/self/exe";
    CLEW_RETURN_IF_ERROR(bridge::mcap::OutputFile::reserve(path, true));
    return bridge::run_processes(run, layout, {{path, bridge::describe_run(run), 0.0}}, {}, {});
  }
  auto recording = bridge::RecordingSink::create(run, path, true);
  if (!recording.ok()) return recording.error();
  auto report = bridge::run_composed(run, bridge::ComposedLayout{}, recording->get(), {});
  if (!report.ok()) return report;
  const bridge::RecordingAccount closed = (*recording)->close({});
  if (!closed.failure.empty()) return core::Error{closed.failure};
  return report;
}

/// A recording that is removed with this object.
class PassingRecording {
 public:
  PassingRecording()
      : path_(
            (std::filesystem::temp_directory_path() / fmt::format("clew-bench-{}.mcap", ::getpid()))
                .string()) {}
  PassingRecording(const PassingRecording&) = delete;
  PassingRecording& operator=(const PassingRecording&) = delete;
  ~PassingRecording() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// A run of which something is asked that only its recording tells.
struct RecordedRun {
  bridge::RunReport report;
  std::vector<CoveredChoice> coverage;
};

/// Runs recorded in passing: the judge looks at the samples afterwards.
Result<RecordedRun> run_and_look(const runtime::RunPlan& run, bool coverage, TrapJudge& judge) {
  const PassingRecording file;
  auto report = run_recorded(run, file.path());
  if (!report.ok()) return report.error();
  RecordedRun recorded{std::move(report).value(), {}};
  if (recorded.report.interrupted_by != 0) return recorded;
  const auto recording = bridge::RunRecording::open(file.path());
  if (!recording.ok()) return recording.error();
  CLEW_RETURN_IF_ERROR(bridge::copy_samples_before(*recording, UINT64_MAX, judge));
  if (!coverage) return recorded;
  auto counted = coverage_of(*recording, run);
  if (!counted.ok()) return counted.error();
  recorded.coverage = std::move(counted).value();
  return recorded;
}

/// Runs it, as fast as can be where nothing needs a recording.
Result<RecordedRun> run_judged(const runtime::RunPlan& run, bool coverage, TrapJudge& judge) {
  if (coverage || needs_processes(run.graph)) return run_and_look(run, coverage, judge);
  auto report = bridge::run_composed(run, bridge::ComposedLayout{}, &judge, {});
  if (!report.ok()) return report.error();
  return RecordedRun{std::move(report).value(), {}};
}

}  // namespace

Result<runtime::RunPlan> WorldBench::prepare(const Variant& variant, std::uint64_t seed) const {
  runtime::GraphOverrides overrides = variant.overrides;
  overrides.world = world_.name;
  overrides.seed = seed;
  return runtime::prepare_run(variant.graph, overrides, source_, stages_);
}

const WorldBench::Truth* WorldBench::truth(const runtime::RunPlan& run) {
  if (!grid_) {
    surveyed_ = run.setup.world;
    const auto time_s = world_analysis::surveyed_time_s(*surveyed_);
    if (!time_s.ok()) return nullptr;
    grid_ = std::make_unique<world_analysis::ClearanceGrid>(*surveyed_, *time_s);
  }
  const double radius_m = run.setup.behaviour.robot.radius_m;
  const auto known = truth_by_radius_.find(radius_m);
  if (known != truth_by_radius_.end()) return &known->second;
  // Minima shallower than the robot is wide are none.
  world_analysis::TrapMap traps(*grid_, radius_m, 2.0 * radius_m);
  auto severity = world_analysis::severity_of(*grid_, traps, radius_m);
  return &truth_by_radius_.emplace(radius_m, Truth{std::move(traps), std::move(severity)})
              .first->second;
}

Result<std::optional<std::string>> WorldBench::run(const Variant& variant, std::uint64_t seed) {
  const auto run = prepare(variant, seed);
  if (!run.ok()) return run.error();
  const world::World& world = *run->setup.world;
  const Truth* const known = truth(*run);
  TrapJudge judge(known == nullptr ? nullptr : &known->traps, run->setup.behaviour.robot.radius_m,
                  detectors_of(run->graph));
  const bool as_processes = needs_processes(run->graph);
  const auto ran = run_judged(*run, plan_.coverage, judge);
  if (!ran.ok()) return ran.error();
  const bridge::RunReport& report = ran->report;
  if (report.interrupted_by != 0) return std::optional<std::string>();

  ordered_json line;
  line["graph"] = variant.graph;
  line["variant"] = variant.text();
  line["world"] = world_.name;
  line["family"] = world_.family;
  const tools::RunFacts facts =
      as_processes ? tools::RunFacts{"processes", bridge::ProcessLayout{}.middleware, ""}
                   : tools::RunFacts{"composed", "inprocess", ""};
  auto as_run = ordered_json::parse(tools::report_json(report, *run, facts));
  // As the suite names them, which may be by a path.
  as_run["graph"] = line["graph"];
  as_run["world"] = line["world"];
  line.update(as_run);
  const auto success = is_success(as_run["outcome"], world);
  line["success"] = success ? ordered_json(*success) : ordered_json(nullptr);
  line["solvable"] = world.solvable() ? ordered_json(*world.solvable()) : ordered_json(nullptr);
  line.update(severity_json(known == nullptr ? nullptr : &known->severity,
                            run->setup.behaviour.scan.range_max_m, source_.depth_ranges()));
  line["captures"] = judge.has_truth() ? ordered_json(judge.captures()) : ordered_json(nullptr);
  line["held_at_end"] = judge.has_truth() ? ordered_json(judge.is_held()) : ordered_json(nullptr);
  line["detectors"] = to_json(judge);
  if (plan_.coverage) line["coverage"] = to_json(ran->coverage);
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
  const auto report = run_recorded(*run, path);
  return report.ok() ? Result<void>() : Result<void>(report.error());
}

}  // namespace clew::bench
