// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/graph.hpp"

namespace clew::tools {

/// What `clew replay` was asked for.
struct ReplayOptions {
  std::string recording;
  std::string component;  ///< a stage; empty: all
  runtime::GraphOverrides overrides;
  std::optional<std::uint64_t> first_tick;
  std::optional<std::uint64_t> last_tick;
  std::optional<std::uint64_t> branch_tick;
  double rate = 0.0;   ///< simulated over wall-clock time; 0: as fast as possible
  std::string record;  ///< of the branch
  bool force = false;
  bool json = false;
  std::vector<std::string> plugins;  ///< names or paths
  bool publishes = false;            ///< over DDS, instead of into a component in this process
  std::vector<std::string> publish;  ///< topics besides the component's inputs
  std::optional<int> domain;
  std::string middleware = "cyclonedds";
  bool start = false;                ///< the component's process
  std::vector<std::string> exec;     ///< the programs that the recording may have started
  std::string prefix;                ///< `STAGE=COMMAND`, which starts it too
  std::vector<std::string> readers;  ///< programs to start
  std::optional<double> wait_s;
  bool start_paused = false;
  bool commands = false;  ///< from stdin
  bool loop = false;
  std::vector<std::string> remap;  ///< `TOPIC:=NAME`
};

}  // namespace clew::tools
