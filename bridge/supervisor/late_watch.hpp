// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "domain/incident.hpp"
#include "runtime/run_plan.hpp"
#include "supervisor/member.hpp"
#include "supervisor/process_activity.hpp"

namespace clew::bridge {

/// Names a component that does not come out of a step, and says what its process does instead: it
/// is stopped, it uses a processor (a busy loop), or it waits (a sleep, a dead-lock).
///
/// Time counts against it only while it uses a processor, or wants none. Who wants one and is given
/// none suffers from the machine's load, and is not named. In real time a step is too long after
/// the larger of 0.3 s and two ticks, in lockstep after ten seconds: a large search takes its time.
/// Components on other hosts are not watched.
class LateWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  /// The kind of domain::Incident that it tells.
  static constexpr const char* kIncident = "late_component";
  using Activity = std::function<std::optional<ProcessActivity>(std::int64_t process_id)>;
  /// Ticks that a third-party component has written, as far as the run has read them.
  using TicksOf = std::function<std::uint64_t(const Member&)>;

  LateWatch(const runtime::RunPlan& plan, bool realtime, Activity activity = activity_of);

  /// Who has become too late since the last call; each is named once a tick.
  std::vector<domain::Incident> watch(const std::vector<Member>& members, const TicksOf& written,
                                      Time now);
  /// Nothing of the past counts any more.
  void forget() { suspects_.clear(); }

 private:
  /// Since a component was first seen in a step.
  struct Suspect {
    std::uint64_t ticks = 0;
    Time since;
    Time looked_at;
    std::optional<ProcessActivity> seen;
    double used_s = 0.0;
    double waited_s = 0.0;
    bool told = false;
  };

  bool is_suspicious(const Member& member, const std::vector<Member>& members,
                     const TicksOf& written, Time now) const;
  bool inputs_are_there(const Member& member, const std::vector<Member>& members,
                        const TicksOf& written) const;
  /// Counts what has passed since the last look.
  static void look(Suspect& suspect, const ProcessActivity& activity, Time now);
  std::string what(const Member& member, const Suspect& suspect, Time now) const;

  const runtime::RunPlan& plan_;
  const bool realtime_;
  const double limit_s_;
  const Activity activity_;
  std::map<std::string, Suspect> suspects_;  ///< by the member's name
};

}  // namespace clew::bridge
