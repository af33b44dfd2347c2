// SPDX-License-Identifier: Apache-2.0
#include "supervisor/late_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "run/limits.hpp"

namespace clew::bridge {
namespace {

double seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

std::int64_t process_id_of(const Member& member) {
  return member.child ? static_cast<std::int64_t>(member.child->process_id()) : member.process_id;
}

const Member* member_of(const std::vector<Member>& members, const std::string& stage) {
  for (const Member& member : members) {
    if (std::count(member.stages.begin(), member.stages.end(), stage) > 0) return &member;
  }
  return nullptr;
}

std::uint64_t ticks_of(const Member& member, const LateWatch::TicksOf& written) {
  return member.third_party ? written(member) : member.progress.ticks;
}

}  // namespace

LateWatch::LateWatch(const runtime::RunPlan& plan, bool realtime, Activity activity)
    : plan_(plan),
      realtime_(realtime),
      limit_s_(realtime ? std::max(kLateAfter_s, kLateAfterTicks * plan.graph.tick_s)
                        : kLateInLockstepAfter_s),
      activity_(std::move(activity)) {}

std::vector<domain::Incident> LateWatch::watch(const std::vector<Member>& members,
                                               const TicksOf& written, Time now) {
  std::vector<domain::Incident> late;
  for (const Member& member : members) {
    if (!is_suspicious(member, members, written, now)) {
      suspects_.erase(member.stage);
      continue;
    }
    const std::uint64_t ticks = ticks_of(member, written);
    const auto [known, is_new] = suspects_.try_emplace(member.stage);
    Suspect& suspect = known->second;
    if (is_new || suspect.ticks != ticks) {
      suspect = Suspect{ticks, now, now, {}, 0.0, 0.0, false};
    }
    if (now - suspect.since < (realtime_ ? kLateLookAfter : kLateLookInLockstepAfter)) continue;
    if (suspect.seen && now - suspect.looked_at < kLateLookPeriod) continue;
    const auto activity = activity_(process_id_of(member));
    if (!activity) continue;
    look(suspect, *activity, now);
    const bool stopped = realtime_ && activity->stopped;
    if (suspect.told || (!stopped && std::max(suspect.used_s, suspect.waited_s) < limit_s_)) {
      continue;
    }
    suspect.told = true;
    late.push_back({0, kIncident, member.stage, what(member, suspect, now)});
  }
  return late;
}

bool LateWatch::is_suspicious(const Member& member, const std::vector<Member>& members,
                              const TicksOf& written, Time now) const {
  // Of a process on another host the kernel here knows nothing.
  if (member.down || !member.host.empty() || process_id_of(member) == 0) return false;
  // What it does is seen on the wire only. In lockstep its graph says for how long to wait.
  if (member.third_party) return realtime_ && inputs_are_there(member, members, written);
  if (!member.link) return false;
  return member.busy || (realtime_ && now - member.heard_at > kSilentAfter);
}

bool LateWatch::inputs_are_there(const Member& member, const std::vector<Member>& members,
                                 const TicksOf& written) const {
  const std::uint64_t ticks = written(member);
  for (const std::string& stage : member.stages) {
    const runtime::GraphStage& own = *plan_.graph.find(stage);
    if (own.ports.delayed_inputs.any()) return false;  // it starts ticks when it likes
    for (const runtime::Topic topic : domain::kAllTopics) {
      if (!own.ports.inputs[index_of(topic)]) continue;
      const Member* writer = member_of(members, plan_.graph.writer_of(topic)->info->name);
      if (writer == nullptr || ticks_of(*writer, written) <= ticks) return false;
    }
  }
  return true;
}

void LateWatch::look(Suspect& suspect, const ProcessActivity& activity, Time now) {
  const auto passed = now - suspect.looked_at;
  suspect.looked_at = now;
  const auto before = std::exchange(suspect.seen, activity);
  if (!before) return;
  const double used_s = std::max(activity.processor_s - before->processor_s, 0.0);
  suspect.used_s += used_s;
  const bool starved = activity.runnable || before->runnable;
  if (!starved && used_s == 0.0) suspect.waited_s += seconds(passed);
}

std::string LateWatch::what(const Member& member, const Suspect& suspect, Time now) const {
  const char* doing = "waits, as in a sleep or a dead-lock";
  if (suspect.used_s > suspect.waited_s) doing = "uses the processor, as a busy loop does";
  if (suspect.seen->stopped) doing = "is stopped";
  const double late_s = seconds(now - suspect.since);
  if (member.third_party) {
    return fmt::format(
        "{} is late: {:.1f} s after its inputs of tick {} it has written nothing; its "
        "process {}",
        member.stage, late_s, suspect.ticks, doing);
  }
  return fmt::format(
      "{} is late: {:.1f} s ago it had done {} ticks, and no more since; its process "
      "{}",
      member.stage, late_s, suspect.ticks, doing);
}

}  // namespace clew::bridge
