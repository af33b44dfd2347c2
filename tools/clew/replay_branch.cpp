// SPDX-License-Identifier: Apache-2.0
#include "clew/replay_branch.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "clew/run_output.hpp"
#include "process/recording_sink.hpp"
#include "replay/branch.hpp"
#include "replay/component_replay.hpp"
#include "replay/recorded_plan.hpp"

namespace clew::tools {
namespace {

using core::Result;

/// The first difference between the recording and what its own configuration gives before the
/// branch, as a sentence; empty without one.
Result<std::string> difference_before(const ReplayOptions& options,
                                      const bridge::RunRecording& recording,
                                      const runtime::RunPlan& recorded) {
  const auto own = bridge::first_own_tick(recording);
  if (!own.ok()) return own.error();
  if (*options.branch_tick <= *own) return std::string();
  bridge::ReplayRange range;
  range.first_tick = *own;
  range.last_tick = *options.branch_tick - 1;
  for (const auto& stage : recorded.graph.stages) {
    const std::string& name = stage.info->name;
    if (!options.component.empty() && name != options.component) continue;
    if (!stage.deployment.exec.empty()) continue;
    const auto report = bridge::replay_component(recording, recorded, name, range);
    if (!report.ok()) return report.error();
    if (report->identical()) continue;
    return fmt::format("{} does not do what is recorded, at tick {} in {}.{}: no branch from there",
                       name, report->first->tick, domain::topic_name(report->first->topic),
                       report->first->fields.front().path);
  }
  return std::string();
}

/// The bundle of the branch's recording: that of the recording it branches off, if they are the
/// same run.
void settle_bundle(const bridge::RunRecording& recording, std::uint64_t own_tick,
                   const runtime::RunPlan& recorded, std::uint64_t tick, runtime::RunPlan& plan) {
  if (plan.bundle == recorded.bundle && tick >= own_tick) {
    plan.bundle = recording.description().bundle;
  } else if (tick > 0) {
    bridge::note_branch(recording.description().bundle, tick, plan);
  }
}

}  // namespace

int replay_branch(const ReplayOptions& options, const bridge::RunRecording& recording,
                  const runtime::RunPlan& recorded, const runtime::RunPlan& changed) {
  const std::uint64_t tick = *options.branch_tick;
  if (!options.component.empty() && recorded.graph.find(options.component) == nullptr) {
    return complain({"the recording has no stage '" + options.component + "'", {}, 0, 0});
  }
  const auto difference = difference_before(options, recording, recorded);
  if (!difference.ok()) return complain(difference.error());
  if (!difference->empty()) {
    return complain({*difference, recording.path(), 0, 0}, kExitFailed);
  }
  const auto own = bridge::first_own_tick(recording);
  if (!own.ok()) return complain(own.error());
  runtime::RunPlan plan = changed;
  settle_bundle(recording, *own, recorded, tick, plan);
  auto start = bridge::branch_off(recording, plan, tick);
  if (!start.ok()) return complain(start.error());
  std::unique_ptr<bridge::RecordingSink> sink;
  if (!options.record.empty()) {
    auto created = bridge::RecordingSink::create(plan, options.record, options.force);
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
    const auto closed = sink->close();
    if (!closed.ok() && report->aborted.empty()) report->aborted = closed.error().text();
  }
  if (!report->aborted.empty()) fmt::print(stderr, "clew: {}\n", report->aborted);
  const RunFacts facts{"composed", "inprocess", options.record, tick};
  std::puts(options.json ? report_json(*report, plan, facts).c_str()
                         : report_line(*report, plan).c_str());
  return exit_status(*report);
}

}  // namespace clew::tools
