// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
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

/// Runs one stage as a process of its own: takes its assignment from the run that holds `domain`,
/// meets the other components on the wire, and steps until the run is over. `connect_timeout_s`
/// says how long to wait for the run. Returns the exit status: 0 when the run ended as it should,
/// 1 otherwise; what went wrong is on stderr.
int run_component_process(const std::string& stage, int domain, double connect_timeout_s,
                          const std::vector<runtime::StageInfo>& stages, const MeetRobots& meet);

}  // namespace clew::bridge
