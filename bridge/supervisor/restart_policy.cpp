// SPDX-License-Identifier: Apache-2.0
#include "supervisor/restart_policy.hpp"

#include <algorithm>
#include <csignal>
#include <cstdint>

#include "run/limits.hpp"

namespace clew::bridge {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

std::string RestartPolicy::take(Member& member, Time now) {
  if (!graph_.find(member.stages.front())->deployment.may_restart()) {
    return "; a third-party component is not restarted, unless its graph says 'restart: "
           "stateless'";
  }
  if (!member.child) return "; a person started it";
  if (member.restarts >= graph_.find(member.stages.front())->deployment.restart_limit) {
    return "; it was restarted " + std::to_string(member.restarts) + " times, which is its limit";
  }
  if (member.deaths_in_place >= kDeathsInPlace) {
    return "; it does so every time after tick " + std::to_string(member.lost_at);
  }
  // A kill comes from outside, and need not come again.
  const bool in_place = member.restarts > 0 && member.progress.ticks <= member.lost_at;
  member.deaths_in_place = in_place && !member.child->was_killed() ? member.deaths_in_place + 1 : 0;
  ++member.restarts;
  take_down(member, now);
  if (!member.third_party) go_back_together(now);
  return {};
}

void RestartPolicy::take_down(Member& member, Time now) {
  member.lost_at = std::max(member.lost_at, member.progress.ticks);
  member.down = true;
  member.catching_up = !member.third_party;
  member.finished.reset();
  const double backoff_s = graph_.find(member.stages.front())->deployment.restart_backoff_s;
  const auto backoff =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(backoff_s));
  const Clock::duration least = member.third_party ? kThirdPartyBackoff : Clock::duration{};
  member.restart_at = now + std::max(backoff, least);
}

void RestartPolicy::go_back_together(Time now) {
  std::vector<const Member*> lost;
  std::uint64_t passed_by_all = UINT64_MAX;
  for (Member& member : members_) {
    if (member.catching_up) {
      if (!member.down) {
        member.child->signal(SIGKILL);
        member.link.reset();
        take_down(member, now);
      }
      lost.push_back(&member);
    } else if (!member.third_party) {
      passed_by_all = std::min(passed_by_all, member.progress.ticks);
    }
  }
  const std::uint64_t tick = common_checkpoint(lost, passed_by_all);
  for (Member& member : members_) {
    if (!member.catching_up) continue;
    auto& kept = member.checkpoints;
    while (!kept.empty() && kept.back().tick > tick) kept.pop_back();
  }
}

std::vector<Member*> RestartPolicy::due(Time now) {
  std::vector<Member*> due;
  for (Member& member : members_) {
    if (!member.down || now < member.restart_at) continue;
    member.child->reap();
    if (!member.child->running()) due.push_back(&member);
  }
  return due;
}

std::vector<std::string> RestartPolicy::kill_frozen(Time now, Time::duration limit) {
  std::vector<std::string> lines;
  for (Member& member : members_) {
    if (member.progress.ticks > member.frozen_at) member.frozen_in_place = 0;
    const Time::duration least = member.host.empty() ? limit : limit + kLostReports;
    const auto patience = least * (1U << std::min(member.frozen_in_place, kMostDoublings));
    if (!member.link || !member.child || now - member.heard_at < patience) continue;
    member.frozen_at = member.progress.ticks;
    ++member.frozen_in_place;
    lines.push_back(member.stage + " (process " + std::to_string(member.child->process_id()) +
                    ") does not report; killing it");
    member.child->signal(SIGKILL);
    member.heard_at = now;
  }
  return lines;
}

std::vector<std::string> RestartPolicy::kill_lonely(Time now, Time::duration limit) {
  for (const Member& member : members_) {
    if (!member.link || !member.child || now - member.joined_at < limit) return {};
  }
  std::vector<std::string> lines;
  for (Member& member : members_) {
    if (member.ready || member.was_lonely || member.missing.empty()) continue;
    member.was_lonely = true;
    lines.push_back(member.missing.front() + ", which is there; killing process " +
                    std::to_string(member.child->process_id()));
    member.child->signal(SIGKILL);
  }
  return lines;
}

}  // namespace clew::bridge
