// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/geometry.hpp"
#include "core/result.hpp"
#include "ros2/messages.hpp"

namespace clew::bag_import {

/// Which topics of a bag are read; empty: the only one of its type.
struct BagTopics {
  std::string scan;
  std::string odometry;
};

/// A robot's scans and odometry, in the order of their stamps.
struct RobotBag {
  std::vector<ros2::LaserScan> scans;
  std::vector<ros2::Odometry> odometry;
  core::Pose2 pose_robot_laser;  ///< from /tf_static; the robot's centre if that does not tell
  bool laser_is_known = false;
};

/// Reads a bag of rosbag2: its directory, or its MCAP file. Refused: storage other than MCAP, a
/// topic that is not there or not of its type, several to choose from, and damaged files.
core::Result<RobotBag> read_bag(const std::string& path, const BagTopics& topics);

}  // namespace clew::bag_import
