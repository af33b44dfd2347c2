// SPDX-License-Identifier: Apache-2.0
#include "replay/resumption.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "replay/black_box_past.hpp"
#include "replay/component_replay.hpp"
#include "replay/process_past.hpp"
#include "replay/recorded_past.hpp"
#include "replay/recorded_plan.hpp"

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;
using domain::Topic;
using runtime::TopicSet;

Result<RecordedPast> past_of(const RunRecording& recording, const runtime::RunPlan& plan,
                             const RecordedChanges& changes) {
  auto nodes = make_own_nodes(plan);
  if (!nodes.ok()) return nodes.error();
  auto robot = recorded_robot(recording, plan);
  if (!robot.ok()) return robot.error();
  auto successions = runtime::alone(std::move(nodes).value());
  for (runtime::NodeSuccession& node : successions) {
    runtime::add_successors(plan, changes.interventions, changes.plans, node);
  }
  return RecordedPast::begin(recording, plan, std::move(successions), std::move(robot).value());
}

/// After the first tick that is not whole: a topic that it lacks must have ended there.
Result<void> check_rest(TickReader& reader, TopicSet missing, std::uint64_t tick) {
  while (true) {
    const auto later = reader.next();
    if (!later.ok()) return later.error();
    if (*later == nullptr) return {};
    const TopicSet goes_on = missing & (*later)->present();
    for (Topic topic : domain::kAllTopics) {
      if (!goes_on[index_of(topic)]) continue;
      return Error{fmt::format("lacks '{}' of tick {}, and has later ones: it cannot be continued",
                               domain::topic_name(topic), tick)};
    }
  }
}

Result<void> check_in_time(const RecordedPast& past, std::uint64_t tick) {
  if (!std::get<domain::State>(past.messages()).command_late) return {};
  return Error{
      fmt::format("was recorded in real time, and the command of tick {} was late: what the "
                  "wall clock decides cannot be continued",
                  tick - 1)};
}

/// Feeds what is whole; returns the number of ticks.
Result<std::uint64_t> feed(const RunRecording& recording, std::uint64_t checked_from,
                           RecordedPast& past, ProcessPast& processes) {
  const TopicSet topics = past.topics();
  TickReader reader(recording, topics);
  for (std::uint64_t tick = 0;; ++tick) {
    const auto found = reader.next();
    if (!found.ok()) return found.error();
    if (*found == nullptr) return tick;
    const RecordedTick& recorded = **found;
    if (recorded.tick() != tick) {
      return Error{fmt::format("has no tick {}: it cannot be continued", tick)};
    }
    if (recorded.present() != topics) {
      CLEW_RETURN_IF_ERROR(check_rest(reader, topics & ~recorded.present(), tick));
      return tick;
    }
    CLEW_RETURN_IF_ERROR(past.add(recorded));
    CLEW_RETURN_IF_ERROR(check_in_time(past, tick));
    if (tick >= checked_from) CLEW_RETURN_IF_ERROR(past.check_outputs(recorded));
    processes.add(past, recorded);
  }
}

/// A recording has the files of planned changes in its bundle; a plan's own bundle, of which
/// processes are made, has not. So the first change brings them.
void bring_files(const RunRecording& recording, const runtime::RunPlan& plan,
                 std::vector<domain::Intervention>& interventions) {
  for (domain::Intervention& intervention : interventions) {
    if (intervention.changes.empty()) continue;
    for (const auto& [name, text] : recording.description().bundle) {
      if (plan.bundle.count(name) == 0) intervention.files.emplace(name, text);
    }
    return;
  }
}

}  // namespace

Result<Resumption> resume(const RunRecording& recording, const runtime::RunPlan& plan) {
  const auto started_at = std::chrono::steady_clock::now();
  const auto in_recording = [&](const Error& error) {
    return Error{error.text(), recording.path()};
  };
  CLEW_RETURN_IF_ERROR(refuse_black_box(recording, "it cannot be continued"));
  CLEW_RETURN_IF_ERROR(refuse_left_out(recording, "it cannot be continued"));
  const auto branch = branch_of(recording);
  if (!branch.ok()) return branch.error();
  const std::uint64_t branched_at = *branch ? (*branch)->tick : 0;
  auto changes = recorded_changes(recording, plan, *plan.known_stages, true);
  if (!changes.ok()) return changes.error();
  bring_files(recording, plan, changes->interventions);
  auto past = past_of(recording, plan, *changes);
  if (!past.ok()) return in_recording(past.error());
  ProcessPast processes(plan, false);
  const auto ticks = feed(recording, branched_at, *past, processes);
  if (!ticks.ok()) return in_recording(ticks.error());
  if (*branch && *ticks <= branched_at) {
    return in_recording({fmt::format("has {} whole ticks, and branched off another run at tick {}: "
                                     "branch that one off again",
                                     *ticks, branched_at),
                         {},
                         0,
                         0});
  }
  Resumption resumption{std::move(changes->interventions),
                        std::move(changes->plans),
                        past->has_ended(),
                        {{}, *ticks, {}, SampleAccount(true, false), started_at},
                        processes.start(*past, *ticks)};
  resumption.processes.interventions = resumption.interventions;
  CLEW_RETURN_IF_ERROR(past->hand_over(resumption.composed));
  return resumption;
}

}  // namespace clew::bridge
