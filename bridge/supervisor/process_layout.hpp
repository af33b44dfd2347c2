// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "line/frames.hpp"
#include "run/pace.hpp"

namespace clew::bridge {

/// The hosts of a run, if it has others than this one.
struct HostsLayout {
  std::string file;                         ///< the list of hosts, as a path
  std::map<std::string, std::string> host;  ///< by stage
  std::vector<std::string> addresses;       ///< of this host, and of all those
  std::string fallback;  ///< where components go whose host is lost: RelayOrder::fallback
};

/// How to run a plan as separate processes. Nothing here changes what is computed.
struct ProcessLayout {
  std::string program;                                  ///< the clew command
  std::map<std::string, std::string> stage_program;     ///< by stage: another version of it
  std::string middleware = "cyclonedds";                ///< of stages that do not say
  std::map<std::string, std::string> stage_middleware;  ///< by stage
  std::optional<int> domain;                            ///< none: the first free one
  std::string name;                                     ///< under which it is found; may be empty
  Pace pace = Pace::kLockstep;
  double pace_factor = 1.0;
  int realtime_priority = 0;  ///< of component processes: 1 to 99, first in, first out; 0: none
  /// A directory of keys, or empty: keys for this run alone. None: as the graph says.
  std::optional<std::string> security;
  bool hash = true;
  OnRecordError on_record_error = OnRecordError::kStop;
  std::set<std::string> external;             ///< stages that a person starts
  std::map<std::string, std::string> prefix;  ///< by stage: `gdb --args`
  std::optional<HostsLayout> hosts;           ///< none: all is here
};

/// Where a run begins that is under way: every component has stepped all ticks before.
struct ProcessStart {
  std::uint64_t next_tick = 0;
  std::map<std::string, Checkpoint> checkpoints;  ///< by stage, at `next_tick`; none at tick 0
  std::string spooled;  ///< samples before that, for a recording that is to have them, too
  /// What changed before, and what is to change later.
  std::vector<domain::Intervention> interventions = {};
};

}  // namespace clew::bridge
