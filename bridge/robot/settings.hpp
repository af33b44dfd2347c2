// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry.hpp"
#include "core/result.hpp"
#include "ros2/environment.hpp"
#include "vendors/participant_factory.hpp"

namespace clew::robot {

/// Where a robot of ROS 2 is found, and how it is spoken to: what stands in `ros2` of a stage.
struct Settings {
  ros2::RosNetwork network;
  ros2::Distro distro = ros2::Distro::kJazzy;
  bridge::Vendor vendor = bridge::Vendor::kCycloneDds;
  std::string node_name;
  std::string node_namespace = "/";
  // Whole names: `/r1/scan`.
  std::string scan_topic;
  std::string odometry_topic;
  std::string command_topic;
  bool stamped = false;              ///< commands are TwistStamped
  double timeout_s = 0.5;            ///< a robot that is silent for so long is told to stand still
  double give_up_s = 10.0;           ///< and after so long the run ends
  double brake_margin_m = 0.02;      ///< what the scan shows is not come nearer to than this
  std::optional<core::Pose2> laser;  ///< in the robot's frame; none: as /tf and /tf_static say
};

/// The keys that `ros2` of a stage may have.
const std::vector<std::string>& setting_names();

/// Reads them; `variable` gives what ROS says of the network, `node` is the node's name unless
/// another is given. Refused: unknown keys, and values that are none, with what is allowed.
core::Result<Settings> read_settings(const std::map<std::string, std::string>& texts,
                                     const ros2::Variables& variable, const std::string& node);

}  // namespace clew::robot
