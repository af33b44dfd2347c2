// SPDX-License-Identifier: Apache-2.0
#include "clew/replay_branch.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>

#include "clew/exit_status.hpp"
#include "clew/foreign_programs.hpp"
#include "clew/own_program.hpp"
#include "clew/run_output.hpp"
#include "log/log.hpp"
#include "recorder/recording_sink.hpp"
#include "recording/output_file.hpp"
#include "replay/black_box_past.hpp"
#include "replay/branch.hpp"
#include "replay/component_replay.hpp"
#include "replay/process_past.hpp"
#include "replay/recorded_plan.hpp"
#include "supervisor/process_run.hpp"

namespace clew::tools {
namespace {

/// Why there is no branch after what a component does that is not recorded.
core::Error unfaithful_error(const bridge::RunRecording& recording,
                             const bridge::ReplayReport& report) {
  return {fmt::format("{} does not do what is recorded, at tick {} in {}.{}: there is no branch "
                      "from later ones",
                      report.component, report.first->tick, domain::topic_name(report.first->topic),
                      report.first->fields.front().path),
          recording.path()};
}

/// The recording of a branch without a change is that of the run; else it says where it began: with
/// the state that `robot` gives.
template <typename Robot>
void settle_bundle(const bridge::RunRecording& recording, const runtime::RunPlan& recorded,
                   std::uint64_t tick, const Robot& robot, runtime::RunPlan& plan) {
  if (plan.bundle == recorded.bundle) {
    plan.bundle = recording.description().bundle;
  } else if (tick > 0) {
    bridge::note_branch(recording.description().bundle, robot(), plan);
  }
}

int print_report(const ReplayOptions& options, const bridge::RunReport& report,
                 const runtime::RunPlan& plan, const char* layout, const char* middleware) {
  if (!report.aborted.empty()) logs::error("{}", report.aborted);
  const RunFacts facts{layout, middleware, options.record, options.branch_tick};
  fmt::print("{}\n", options.json ? report_json(report, plan, facts) : report_line(report, plan));
  return exit_status(report);
}

/// With third-party components the branch goes on as processes.
int branch_processes(const ReplayOptions& options, const bridge::RunRecording& recording,
                     const runtime::RunPlan& recorded, runtime::RunPlan plan) {
  const std::uint64_t tick = *options.branch_tick;
  const auto start = bridge::branch_off_processes(recording, recorded, plan, tick);
  if (!start.ok()) return complain(start.error());
  for (const auto& checked :
       {check_programs_are_named(plan.graph, options.exec), check_programs(plan.graph, {})}) {
    if (!checked.ok()) return complain(checked.error());
  }
  settle_bundle(
      recording, recorded, tick, [&] { return bridge::robot_of(*start, plan); }, plan);
  std::optional<bridge::RecordingOrder> order;
  if (!options.record.empty()) {
    const auto reserved = bridge::mcap::OutputFile::reserve(options.record, options.force);
    if (!reserved.ok()) return complain(reserved.error());
    order = {options.record, bridge::describe_run(plan), 0.0};
  }
  bridge::ProcessLayout layout;
  layout.program = own_program();
  if (options.rate > 0.0) {
    layout.pace = bridge::Pace::kScaled;
    layout.pace_factor = options.rate;
  }
  auto report = bridge::run_processes(plan, layout, order, terminal_display(plan), *start);
  clear_display();
  if (!report.ok()) return complain(report.error());
  if (report->recording && report->aborted.empty()) {
    report->aborted = bridge::complaint(*report->recording);
  }
  return print_report(options, *report, plan, "processes", layout.middleware.c_str());
}

}  // namespace

int replay_branch(const ReplayOptions& options, const bridge::RunRecording& recording,
                  const runtime::RunPlan& recorded, const runtime::RunPlan& changed) {
  const std::uint64_t tick = *options.branch_tick;
  if (!options.component.empty() && recorded.graph.find(options.component) == nullptr) {
    return complain({"the recording has no stage '" + options.component + "'", {}, 0, 0});
  }
  const auto unfaithful = bridge::find_unfaithful(recording, recorded, tick, options.component);
  if (!unfaithful.ok()) return complain(unfaithful.error());
  if (*unfaithful) return complain(unfaithful_error(recording, **unfaithful), kExitFailed);
  if (bridge::has_third_party(changed)) {
    return branch_processes(options, recording, recorded, changed);
  }
  runtime::RunPlan plan = changed;
  auto start = bridge::branch_off(recording, recorded, plan, tick);
  if (!start.ok()) return complain(start.error());
  settle_bundle(
      recording, recorded, tick, [&] { return bridge::robot_of(*start); }, plan);
  std::unique_ptr<bridge::RecordingSink> sink;
  if (!options.record.empty()) {
    bridge::RunDescription description = bridge::describe_run(plan);
    auto box = bridge::black_box_for(recording, plan);
    if (!box.ok()) return complain(box.error());
    description.black_box = std::move(box).value();
    auto created = bridge::RecordingSink::create(description, options.record, options.force);
    if (!created.ok()) return complain(created.error());
    sink = std::move(created).value();
    const auto copied = bridge::copy_samples_before(recording, tick, *sink);
    if (!copied.ok()) return complain(copied.error(), kExitFailed);
  }

  bridge::ComposedLayout layout;
  if (options.rate > 0.0) {
    layout.pace = bridge::Pace::kScaled;
    layout.pace_factor = options.rate;
  }
  auto report = bridge::run_composed(plan, std::move(start).value(), layout, sink.get(),
                                     terminal_display(plan));
  clear_display();
  if (!report.ok()) return complain(report.error());
  if (sink) {
    const std::string what = bridge::complaint(sink->close({}));
    if (report->aborted.empty()) report->aborted = what;
  }
  return print_report(options, *report, plan, "composed", "inprocess");
}

}  // namespace clew::tools
