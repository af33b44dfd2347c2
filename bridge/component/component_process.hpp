// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// What a process tells those who make its robots' nodes.
struct RobotHost {
  std::string run_id;
  int domain = 0;  ///< the run's own
  std::function<void(std::string)> on_notice;
  std::function<void(std::string)> on_fatal;  ///< the run cannot go on
};
/// What a process needs to have robots in the place of its stages; this room does not know ROS.
struct RobotMaker {
  runtime::MakeNode make;             ///< the node of a stage that has `ros2`
  std::function<void()> stand_still;  ///< the last word to all of them: the process ends
};
using MeetRobots = std::function<RobotMaker(RobotHost)>;

/// Where a component finds its run.
struct RunPlace {
  int domain = 0;
  double connect_timeout_s = 0.0;  ///< how long to wait for the run that holds the domain
  /// A connected line to it, by the descriptor's number, and no run of this host.
  std::optional<int> line = {};
  /// The programs that the run may start here, and the plug-ins that it may load, as paths; none:
  /// any, as the user's own run may.
  std::optional<std::vector<std::string>> allowed = {};
};

/// Runs one stage as a process of its own: takes its assignment from its run, meets the other
/// components on the wire, and steps until the run is over. Returns the exit status: 0 when the run
/// ended as it should, 1 otherwise; what went wrong is on stderr.
int run_component_process(const std::string& stage, const RunPlace& place,
                          const std::vector<runtime::StageInfo>& stages, const MeetRobots& meet);

}  // namespace clew::bridge
