// SPDX-License-Identifier: Apache-2.0
#include "replay/branch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "replay/black_box_past.hpp"
#include "replay/process_past.hpp"
#include "replay/recorded_past.hpp"
#include "replay/recorded_plan.hpp"

namespace clew::bridge {
namespace {

using core::Result;

/// What can be said of a branch before any sample is read.
Result<void> check(const RunRecording& recording, const runtime::RunPlan& plan,
                   std::uint64_t tick) {
  const auto refuse = [&](std::string what) {
    return core::Error{std::move(what), recording.path()};
  };
  CLEW_RETURN_IF_ERROR(refuse_left_out(recording, "no run can be gone on with"));
  const double recorded_s = recording.description().tick_s;
  if (plan.graph.tick_s != recorded_s) {
    return refuse(fmt::format("has ticks of {} s; a branch cannot go on with ticks of {} s",
                              recorded_s, plan.graph.tick_s));
  }
  const auto branch = branch_of(recording);
  if (!branch.ok()) return branch.error();
  if (*branch && tick < (*branch)->tick) {
    return refuse(
        fmt::format("is a branch itself, at tick {}: what is before belongs to the "
                    "recording that it branched off",
                    (*branch)->tick));
  }
  for (const runtime::Intervention& change : recording.interventions()) {
    if (change.changes.empty() || change.tick > tick) continue;
    return refuse(
        fmt::format("is of a run that was changed at tick {}: it can be branched off before "
                    "that",
                    change.tick));
  }
  if (tick < first_fed_tick(recording)) {
    return refuse_black_box(recording, "a branch needs one from there on");
  }
  return {};
}

/// Feeds `past` what is recorded before `tick`, and shows each tick to `added`.
template <typename Added>
Result<void> feed_until(const RunRecording& recording, std::uint64_t tick, RecordedPast& past,
                        const Added& added) {
  const auto refuse = [&](std::string what) {
    return core::Error{std::move(what), recording.path()};
  };
  if (tick > 0) {
    TickReader reader(recording, past.topics(), tick - 1);
    // Of a black box the tick before its first one comes, too.
    const std::uint64_t first = first_fed_tick(recording);
    for (std::uint64_t next = first - std::min<std::uint64_t>(first, 1); next < tick; ++next) {
      const auto found = reader.next();
      if (!found.ok()) return found.error();
      if (*found == nullptr) {
        return refuse(fmt::format("has {} ticks; a branch at tick {} needs as many", next, tick));
      }
      if (const auto fed = past.add(**found); !fed.ok()) return refuse(fed.error().text());
      added(**found);
    }
  }
  if (past.has_ended()) return refuse(fmt::format("the run ended at tick {}", tick - 1));
  return {};
}

Result<RecordedPast> begin_past(const RunRecording& recording, const runtime::RunPlan& recorded,
                                const runtime::RunPlan& plan, std::uint64_t tick) {
  CLEW_RETURN_IF_ERROR(check(recording, plan, tick));
  auto nodes = make_own_nodes(plan);
  if (!nodes.ok()) return nodes.error();
  auto robot = recorded_robot(recording, recorded);
  if (!robot.ok()) return robot.error();
  return RecordedPast::begin(recording, plan, runtime::alone(std::move(nodes).value()),
                             std::move(robot).value());
}

}  // namespace

Result<ComposedStart> branch_off(const RunRecording& recording, const runtime::RunPlan& recorded,
                                 const runtime::RunPlan& plan, std::uint64_t tick) {
  ComposedStart start{{}, tick, {}, SampleAccount(true, false), std::chrono::steady_clock::now()};
  auto past = begin_past(recording, recorded, plan, tick);
  if (!past.ok()) return past.error();
  CLEW_RETURN_IF_ERROR(feed_until(recording, tick, *past, [](const RecordedTick&) {}));
  CLEW_RETURN_IF_ERROR(past->hand_over(start));
  return start;
}

Result<ProcessStart> branch_off_processes(const RunRecording& recording,
                                          const runtime::RunPlan& recorded,
                                          const runtime::RunPlan& plan, std::uint64_t tick) {
  CLEW_RETURN_IF_ERROR(refuse_black_box(recording, "a branch of third-party components needs all"));
  auto past = begin_past(recording, recorded, plan, tick);
  if (!past.ok()) return past.error();
  ProcessPast processes(plan, true);
  CLEW_RETURN_IF_ERROR(feed_until(recording, tick, *past,
                                  [&](const RecordedTick& added) { processes.add(*past, added); }));
  return processes.start(*past, tick);
}

HandOver robot_of(const ProcessStart& start, const runtime::RunPlan& plan) {
  const std::string& name = plan.graph.writer_of(domain::Topic::kState)->info->name;
  return {start.next_tick, start.checkpoints.at(name).node};
}

HandOver robot_of(const ComposedStart& start) {
  for (const runtime::NodeSuccession& node : start.nodes) {
    if (is_robot(node)) return {start.next_tick, node.save()};
  }
  CLEW_CHECK(false, "a plan without drive");
}

Result<std::optional<ReplayReport>> find_unfaithful(const RunRecording& recording,
                                                    const runtime::RunPlan& recorded,
                                                    std::uint64_t tick, const std::string& only) {
  const auto branch = branch_of(recording);
  if (!branch.ok()) return branch.error();
  ReplayRange range;
  if (*branch) range.first_tick = (*branch)->tick;
  if (tick <= std::max(range.first_tick, first_fed_tick(recording))) {
    return std::optional<ReplayReport>();
  }
  range.last_tick = tick - 1;
  for (const auto& stage : recorded.graph.stages) {
    const std::string& name = stage.info->name;
    if (!stage.deployment.is_ours() || (!only.empty() && name != only)) continue;
    auto report = replay_component(recording, recorded, name, range);
    if (!report.ok()) return report.error();
    if (!report->identical()) return std::optional<ReplayReport>(std::move(report).value());
  }
  return std::optional<ReplayReport>();
}

Result<void> copy_samples_before(const RunRecording& recording, std::uint64_t tick,
                                 SampleSink& sink) {
  if (tick == 0) return {};
  SampleFilter filter;
  filter.last_tick = tick - 1;
  SampleStream stream = recording.samples(filter);
  for (;;) {
    const auto sample = stream.next();
    if (!sample.ok()) return sample.error();
    if (!*sample) return {};
    const SampleView& found = **sample;
    CLEW_RETURN_IF_ERROR(sink.add({found.topic, found.tick, found.sequence, found.cdr}));
  }
}

}  // namespace clew::bridge
