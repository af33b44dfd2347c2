// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "supervisor/late_watch.hpp"
#include "supervisor/member.hpp"

namespace clew::bridge {

/// Looks after processes that were started and have not joined yet: they report nothing, so only
/// the kernel can say how they are.
class ArrivalWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit ArrivalWatch(LateWatch::Activity activity) : activity_(std::move(activity)) {}

  /// One that runs, or would if it were given a processor, gets on: Member::worked_at, so that a
  /// busy machine ends no run. One that has been stopped for kFrozenAfter is killed, as a member
  /// that is frozen: another is started in its place. A line for the log for each that is killed.
  std::vector<std::string> watch(std::vector<Member>& members, Time now);

 private:
  struct Arrival {
    int process_id = 0;
    double processor_s = 0.0;
    std::optional<Time> stopped_at;
  };

  LateWatch::Activity activity_;
  std::map<std::string, Arrival> arrivals_;  ///< by member
};

}  // namespace clew::bridge
