// SPDX-License-Identifier: Apache-2.0
#include "hunt/case_run.hpp"

#include <algorithm>
#include <limits>

#include "bench/trap_judge.hpp"
#include "clew/run_output.hpp"
#include "files/scratch_folder.hpp"
#include "recorder/recording_sink.hpp"
#include "recording/output_file.hpp"
#include "recording/run_recording.hpp"
#include "replay/branch.hpp"
#include "run/composed_run.hpp"
#include "supervisor/process_run.hpp"
#include "world/world.hpp"
#include "world_analysis/clearance_grid.hpp"
#include "world_analysis/trap_map.hpp"

namespace clew::hunt {
namespace {

using core::Result;
using runtime::RunPlan;

constexpr double kMostClearance_m = 2.0;
constexpr double kEndless = std::numeric_limits<double>::infinity();

/// The files, with a world of its own.
class CaseSource : public runtime::ConfigSource {
 public:
  CaseSource(const runtime::ConfigSource& configs, const RunCase& which)
      : configs_(configs), which_(which) {}

  Result<core::Resource> find(const std::string& folder, const std::string& name) const override {
    if (folder == "worlds" && name == which_.world_file) {
      return core::Resource{which_.world_file, which_.world_text};
    }
    return configs_.find(folder, name);
  }

 private:
  const runtime::ConfigSource& configs_;
  const RunCase& which_;
};

/// Follows the robot: its clearance, its way, and what the judge of traps says.
class Witness : public bridge::SampleSink {
 public:
  Witness(const world::World& world, double robot_radius_m, bench::TrapJudge* judge,
          bridge::SampleSink* recording)
      : world_(world), robot_radius_m_(robot_radius_m), judge_(judge), recording_(recording) {}

  Result<void> add(const bridge::SampleView& sample) override {
    if (sample.topic == domain::Topic::kState) {
      CLEW_RETURN_IF_ERROR(states_.decode(sample.cdr, state_));
      const core::Vec2 position = state_.pose_world_robot.position();
      const double room_m = world_.clearance_m(position, kMostClearance_m + robot_radius_m_,
                                               state_.stamp.sim_time_s) -
                            robot_radius_m_;
      clearance_m_ = std::min(clearance_m_, std::max(room_m, 0.0));
      track_.push_back(state_.pose_world_robot);
    }
    if (judge_ != nullptr) CLEW_RETURN_IF_ERROR(judge_->add(sample));
    return recording_ == nullptr ? Result<void>() : recording_->add(sample);
  }

  double clearance_m() const { return clearance_m_; }
  const std::vector<core::Pose2>& track() const { return track_; }

 private:
  const world::World& world_;
  double robot_radius_m_;
  bench::TrapJudge* judge_;
  bridge::SampleSink* recording_;
  bridge::Codec<domain::State> states_;
  domain::State state_;
  double clearance_m_ = kMostClearance_m;
  std::vector<core::Pose2> track_;
};

/// The detectors in command, so that one without any alarm is judged as well.
std::vector<bench::DetectorScore> detectors_of(const runtime::Graph& graph) {
  std::vector<bench::DetectorScore> detectors;
  const runtime::GraphStage* recover = graph.find("recover");
  if (recover == nullptr) return detectors;
  const auto chosen = recover->config.parts.find("detector");
  if (chosen == recover->config.parts.end()) return detectors;
  for (const auto& choice : chosen->second) {
    if (choice.name != "none") detectors.push_back({choice.name, false, 0, 0, 0, {}, {}});
  }
  return detectors;
}

/// The least, over detectors, of the longest delay.
double time_to_alarm_s(const bench::TrapJudge& judge) {
  double least_s = kEndless;
  for (const bench::DetectorScore& score : judge.scores()) {
    if (score.shadow || score.noticed < judge.captures()) continue;
    least_s = std::min(least_s, *std::max_element(score.delays_s.begin(), score.delays_s.end()));
  }
  return least_s;
}

void add_judgement(const bench::TrapJudge& judge, FieldValues& values) {
  if (!judge.has_truth()) return;
  values.set(Field::kCaptures, judge.captures());
  values.set(Field::kHeldAtEnd, judge.is_held() ? 1.0 : 0.0);
  double false_alarms = 0.0;
  for (const bench::DetectorScore& score : judge.scores()) {
    if (!score.shadow) false_alarms += score.false_alarms;
  }
  values.set(Field::kFalseAlarms, false_alarms);
  if (judge.captures() > 0) values.set(Field::kTimeToAlarm_s, time_to_alarm_s(judge));
}

void add_world(const world::World& world, const bridge::RunTruth& truth, FieldValues& values) {
  values.set(Field::kDistance_m, core::length(core::Vec2(truth.x_m, truth.y_m) - world.target()));
  if (const auto shortest_m = world.shortest_path_m()) {
    values.set(Field::kShortestPath_m, *shortest_m);
    values.set(Field::kPathRatio, truth.path_length_m / *shortest_m);
  }
  const std::string outcome = values.word(Field::kOutcome);
  if (const auto solvable = world.solvable()) {
    values.set(Field::kSolvable, *solvable ? 1.0 : 0.0);
    values.set(Field::kSuccess, outcome == (*solvable ? "reached" : "unreachable") ? 1.0 : 0.0);
  } else if (outcome != "unreachable") {
    values.set(Field::kSuccess, outcome == "reached" ? 1.0 : 0.0);
  }
}

FieldValues values_of(const bridge::RunReport& report, const RunPlan& plan,
                      const Witness& witness) {
  FieldValues values;
  values.set_word(Field::kOutcome, tools::outcome_word(report));
  const bridge::RunTruth truth = report.statistics.truth.value_or(bridge::RunTruth{});
  const auto ticks = static_cast<double>(truth.tick);
  values.set(Field::kTicks, ticks);
  values.set(Field::kSimTime_s, truth.sim_time_s);
  values.set(Field::kPathLength_m, truth.path_length_m);
  values.set(Field::kClearance_m, witness.clearance_m());
  values.set(Field::kTrapsDetected, report.statistics.traps_detected);
  values.set(Field::kVirtualTargets, report.statistics.virtual_targets);
  values.set(Field::kCollisions, truth.collisions);
  values.set(Field::kHitBy, truth.hit_by);
  values.set(Field::kSafetyStops, truth.safety_stops);
  values.set(Field::kTimeLeft,
             std::max(0.0, 1.0 - ticks / static_cast<double>(plan.setup.max_ticks)));
  add_world(*plan.setup.world, truth, values);
  return values;
}

bool asks_for_traps(const Property& property) {
  return property.uses(Field::kCaptures) || property.uses(Field::kHeldAtEnd) ||
         property.uses(Field::kFalseAlarms) || property.uses(Field::kTimeToAlarm_s);
}

/// The truth about traps of a plan's world.
struct TrapTruth {
  explicit TrapTruth(const RunPlan& plan) {
    const auto time_s = world_analysis::surveyed_time_s(*plan.setup.world);
    if (!time_s.ok()) return;
    const double radius_m = plan.setup.behaviour.robot.radius_m;
    grid.emplace(*plan.setup.world, *time_s);
    map.emplace(*grid, radius_m, 2.0 * radius_m);
  }
  const world_analysis::TrapMap* get() const { return map ? &*map : nullptr; }

  std::optional<world_analysis::ClearanceGrid> grid;
  std::optional<world_analysis::TrapMap> map;
};

/// Runs of a search take place in one process.
Result<void> check_is_ours(const RunPlan& plan) {
  for (const runtime::GraphStage& stage : plan.graph.stages) {
    if (stage.deployment.is_ours()) continue;
    return stage.place.error("stage '" + stage.info->name +
                             "' is a program of somebody else's, or a robot, and these runs take "
                             "place in one process; allowed are graphs without exec and ros2");
  }
  return {};
}

/// `run` runs the plan and shows each of its samples to the witness.
template <typename RunIt>
Result<std::optional<CaseOutcome>> judged_run(const RunPlan& plan, const Property* property,
                                              bridge::SampleSink* recording, const RunIt& run) {
  CLEW_RETURN_IF_ERROR(check_is_ours(plan));
  const double radius_m = plan.setup.behaviour.robot.radius_m;
  std::optional<TrapTruth> truth;
  std::optional<bench::TrapJudge> judge;
  if (property != nullptr && asks_for_traps(*property)) {
    truth.emplace(plan);
    judge.emplace(truth->get(), radius_m, detectors_of(plan.graph));
  }
  Witness witness(*plan.setup.world, radius_m, judge ? &*judge : nullptr, recording);
  const auto report = run(witness);
  if (!report.ok()) return report.error();
  if (report->interrupted_by != 0) return std::optional<CaseOutcome>();
  CaseOutcome outcome;
  outcome.values = values_of(*report, plan, witness);
  if (judge) add_judgement(*judge, outcome.values);
  if (report->hash) outcome.hash = report->hash->hex();
  outcome.ticks = report->statistics.truth ? report->statistics.truth->tick : 0;
  return std::optional<CaseOutcome>(std::move(outcome));
}

}  // namespace

Result<RunPlan> plan_case(const RunCase& which, const Workshop& workshop) {
  runtime::GraphOverrides overrides;
  overrides.world = which.world_file;
  overrides.robot = which.graph.robot;
  overrides.with = which.graph.with;
  overrides.set = which.graph.set;
  overrides.seed = which.seed;
  overrides.max_ticks = which.graph.max_ticks;
  auto plan = runtime::prepare_run(which.graph.graph, overrides,
                                   CaseSource(workshop.configs, which), workshop.stages);
  if (!plan.ok()) return plan;
  CLEW_RETURN_IF_ERROR(check_is_ours(*plan));
  return plan;
}

Result<std::optional<CaseOutcome>> run_plan(const RunPlan& plan, const Property* property,
                                            bridge::SampleSink* recording) {
  return judged_run(plan, property, recording, [&](Witness& witness) {
    return bridge::run_composed(plan, bridge::ComposedLayout{}, &witness, {});
  });
}

Result<std::optional<CaseOutcome>> run_branch(const bridge::RunRecording& recording,
                                              const RunPlan& recorded, const RunPlan& plan,
                                              std::uint64_t tick, const Property* property) {
  return judged_run(plan, property, nullptr, [&](Witness& witness) -> Result<bridge::RunReport> {
    auto start = bridge::branch_off(recording, recorded, plan, tick);
    if (!start.ok()) return start.error();
    CLEW_RETURN_IF_ERROR(bridge::copy_samples_before(recording, tick, witness));
    return bridge::run_composed(plan, std::move(start).value(), bridge::ComposedLayout{}, &witness,
                                {});
  });
}

Result<std::optional<CaseOutcome>> run_as_processes(const RunPlan& plan,
                                                    const bridge::ProcessLayout& layout,
                                                    const Property* property,
                                                    bridge::SampleSink* trace) {
  const auto scratch = files::ScratchFolder::make("clew-run");
  if (!scratch.ok()) return scratch.error();
  const std::string file = scratch->path() + "/run.mcap";
  return judged_run(plan, property, trace, [&](Witness& witness) -> Result<bridge::RunReport> {
    CLEW_RETURN_IF_ERROR(bridge::mcap::OutputFile::reserve(file, true));
    const bridge::RecordingOrder order{file, bridge::describe_run(plan), 0.0};
    auto report = bridge::run_processes(plan, layout, order, {});
    if (!report.ok() || report->interrupted_by != 0) return report;
    if (!report->aborted.empty()) return core::Error{report->aborted};
    const auto recording = bridge::RunRecording::open(file);
    if (!recording.ok()) return recording.error();
    CLEW_RETURN_IF_ERROR(bridge::copy_samples_before(
        *recording, std::numeric_limits<std::uint64_t>::max(), witness));
    return report;
  });
}

std::string verdict_word(const std::optional<Property>& property, const CaseOutcome& outcome) {
  if (!property) return outcome.values.word(Field::kOutcome);
  const auto holds = property->judge(outcome.values).holds;
  return !holds ? "undecided" : *holds ? "holds" : "fails";
}

Result<std::optional<CaseOutcome>> run_case(const RunCase& which, const Property& property,
                                            const Workshop& workshop) {
  const auto plan = plan_case(which, workshop);
  if (!plan.ok()) return plan.error();
  return run_plan(*plan, &property, nullptr);
}

Result<std::vector<core::Pose2>> track_of(const RunCase& which, const Workshop& workshop) {
  const auto plan = plan_case(which, workshop);
  if (!plan.ok()) return plan.error();
  Witness witness(*plan->setup.world, plan->setup.behaviour.robot.radius_m, nullptr, nullptr);
  const auto report = bridge::run_composed(*plan, bridge::ComposedLayout{}, &witness, {});
  if (!report.ok()) return report.error();
  return witness.track();
}

Result<void> record_case(const RunCase& which, const Workshop& workshop,
                         const std::string& recording) {
  const auto plan = plan_case(which, workshop);
  if (!plan.ok()) return plan.error();
  auto sink = bridge::RecordingSink::create(*plan, recording, true);
  if (!sink.ok()) return sink.error();
  const auto report = bridge::run_composed(*plan, bridge::ComposedLayout{}, sink->get(), {});
  if (!report.ok()) return report.error();
  const bridge::RecordingAccount closed = (*sink)->close({});
  if (!closed.failure.empty()) return core::Error{closed.failure};
  return {};
}

}  // namespace clew::hunt
