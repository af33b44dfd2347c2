// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "supervisor/member.hpp"

namespace clew::bridge {

/// Brings back members whose processes were lost. A member goes on from a checkpoint: it loads its
/// state, takes the inputs since then from the histories of their writers, and writes its outputs
/// again, which receivers and the recording drop as far as they have them.
///
/// It must go back far enough for everybody: to a tick that every living member has passed, since a
/// sample that was written just before the death may not have arrived; and members that are down
/// together, or have not yet caught up with themselves, go back to the same tick, since each needs
/// what the others write from there.
class RestartPolicy {
 public:
  using Time = std::chrono::steady_clock::time_point;

  RestartPolicy(std::vector<Member>& members, const runtime::Graph& graph)
      : members_(members), graph_(graph) {}

  /// A member's process has ended. Empty if it will be restarted, else the end of a sentence that
  /// says why not.
  std::string take(Member& member, Time now);
  /// The members whose processes are to be started now.
  std::vector<Member*> due(Time now);
  /// Kills processes that have not reported for `limit`: a frozen process cannot be waited for,
  /// a dead one is restarted. One on another host has kLostReports longer. One that was killed so
  /// and got no further since is given twice as long each time (kMostDoublings). Returns a line for
  /// the log for each.
  std::vector<std::string> kill_frozen(Time now, Time::duration limit);
  /// Kills processes that do not find the others although all of them have been there for `limit`,
  /// each once: discovery among processes that come and go can miss one, and then never
  /// finds it, while another process is found at once. Returns a line for the log for each.
  std::vector<std::string> kill_lonely(Time now, Time::duration limit);

 private:
  void take_down(Member& member, Time now);
  void go_back_together(Time now);

  std::vector<Member>& members_;
  const runtime::Graph& graph_;
};

}  // namespace clew::bridge
