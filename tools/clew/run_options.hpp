// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/graph.hpp"

namespace clew::tools {

/// What `clew run` was asked for.
struct RunOptions {
  std::string graph;
  runtime::GraphOverrides overrides;
  std::string layout;                   ///< empty: as the graph says
  std::vector<std::string> middleware;  ///< `VENDOR` or `STAGE=VENDOR`
  std::string pace;                     ///< empty: lockstep, or real time if a robot takes part
  std::optional<int> domain;
  std::string secure;           ///< `minted`, or a directory of keys; empty: as the graph says
  std::string name;             ///< under which the run is found while it goes on
  std::vector<std::string> at;  ///< `TICK:CHANGE`
  std::optional<int> realtime_priority;
  std::string record;
  std::string resume;             ///< a recording to go on with, in the graph's place
  std::vector<std::string> exec;  ///< with resume, the programs that it may start
  bool force = false;
  std::optional<int> threads;              ///< that a fleet's robots share
  std::vector<std::string> record_topics;  ///< names or patterns; empty: all
  std::uint64_t split_bytes = 0;           ///< 0: one file, whatever its size
  double split_s = 0.0;                    ///< 0: one file, whatever its time
  std::string record_on;                   ///< `trap`: a black box
  std::optional<double> record_last_s;     ///< that a black box keeps; none: 30
  std::string compression;  ///< empty: as the recording that is gone on with has it, else none
  std::string on_record_error = "stop";
  std::vector<std::string> external;
  std::string hosts;                 ///< the file of hosts; empty: none
  std::vector<std::string> host;     ///< `STAGE=NAME`
  std::string fallback = "none";     ///< `local`: whose host is lost goes on here
  std::vector<std::string> prefix;   ///< `STAGE=COMMAND`
  std::vector<std::string> plugins;  ///< names or paths
  bool json = false;
  bool no_hash = false;
  std::string profile;      ///< a trace of where the time went, in this file; empty: none
  std::string ros2;         ///< namespace of a bridge to ROS 2 beside it; empty: there is none
  std::optional<int> view;  ///< a page of the run, at this port; 0: any free one
};

}  // namespace clew::tools
