// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "ros2/environment.hpp"
#include "ros2/names.hpp"
#include "runtime/stage.hpp"
#include "vendors/participant_factory.hpp"

namespace clew::ros2 {

struct BridgeOptions {
  std::string run;  ///< the number of its domain, or its name
  RosNetwork network;
  bridge::Vendor vendor = bridge::Vendor::kCycloneDds;  ///< towards ROS
  Distro distro = Distro::kJazzy;
  std::string node_name = "clew";
  std::string node_namespace = "/";
  std::vector<RemapRule> remap;
  bool takes_goals = false;  ///< from `goal_pose`
  /// Arrival is within this of a goal's orientation, too; none: with any heading.
  std::optional<double> goal_heading_tolerance_rad;
};

/// Shows a live run to ROS 2 until it is over, or SIGINT or SIGTERM comes. Returns the exit status:
/// 0, or 130 after a signal. Refused: no run in the domain.
core::Result<int> run_ros2_bridge(const BridgeOptions& options,
                                  const std::vector<runtime::StageInfo>& stages);

}  // namespace clew::ros2
