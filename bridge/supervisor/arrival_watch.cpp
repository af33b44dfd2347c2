// SPDX-License-Identifier: Apache-2.0
#include "supervisor/arrival_watch.hpp"

#include <csignal>

#include "run/limits.hpp"

namespace clew::bridge {
namespace {

/// One on another host comes when that host answers, and what a program of somebody else's does
/// before it joins is its own affair.
bool is_arriving(const Member& member) {
  return member.child && member.child->running() && !member.link && !member.down &&
         !member.third_party && member.host.empty();
}

}  // namespace

std::vector<std::string> ArrivalWatch::watch(std::vector<Member>& members, Time now) {
  std::vector<std::string> lines;
  for (Member& member : members) {
    if (!is_arriving(member)) {
      arrivals_.erase(member.stage);
      continue;
    }
    const int process_id = member.child->process_id();
    const auto activity = activity_(process_id);
    if (!activity) continue;
    Arrival& arrival = arrivals_[member.stage];
    if (arrival.process_id != process_id) arrival = {process_id, 0.0, std::nullopt};
    if (!activity->stopped) {
      arrival.stopped_at.reset();
      if (activity->runnable || activity->processor_s > arrival.processor_s) member.worked_at = now;
    } else if (!arrival.stopped_at) {
      arrival.stopped_at = now;
    } else if (now - *arrival.stopped_at >= kFrozenAfter) {
      lines.push_back(member.stage + " (process " + std::to_string(process_id) +
                      ") was stopped before it joined; killing it");
      member.child->signal(SIGKILL);
      arrival.stopped_at = now;
    }
    arrival.processor_s = activity->processor_s;
  }
  return lines;
}

}  // namespace clew::bridge
