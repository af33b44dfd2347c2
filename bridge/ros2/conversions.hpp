// SPDX-License-Identifier: Apache-2.0
/// Clew's messages as those of ROS 2. Where the two differ in meaning:
/// - A range of Clew's is measured from the robot's skin, one of ROS from the sensor, which is said
///   to be at the robot's centre: the radius is added.
/// - Nothing within range is +Inf in ROS (REP 117).
/// - Beams of a LaserScan go counter-clockwise.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry.hpp"
#include "domain/messages.hpp"
#include "ros2/messages.hpp"
#include "ros2/names.hpp"
#include "world/world.hpp"

namespace clew::ros2 {

/// The frames of REP 105, by their names in /tf.
struct Frames {
  std::string map = "map";  ///< where Clew's world frame is
  std::string odom;
  std::string base;   ///< the robot's centre, x ahead
  std::string laser;  ///< where scans are said to be measured: the same place

  static Frames of(const Names& names);
};

Time to_time(double seconds);
Quaternion to_quaternion(double heading_rad);
Pose to_pose(const core::Pose2& pose);

LaserScan to_laser_scan(const domain::Scan& scan, const Frames& frames, double radius_m,
                        double tick_s);
Odometry to_odometry(const domain::Odometry& odometry, const Frames& frames);
PoseStamped to_goal(const domain::Target& target, const Frames& frames);
/// From the robot over the target in force to the mission's target: all that the run's topics tell.
Path to_path(const domain::Odometry& odometry, const domain::Guidance& guidance,
             const domain::Target& target, const Frames& frames);

TransformStamped to_transform(const Time& stamp, const std::string& parent,
                              const std::string& child, const core::Pose2& pose);
/// Where the frame `odom` lies in the frame `map`, from one place of the robot in both.
core::Pose2 odom_in_map(const core::Pose2& robot_in_map, const core::Pose2& robot_in_odom);

/// What stands still in a world, as cells of `cell_m` or of as many times that as it takes for at
/// most `most_cells`: 100 where an obstacle reaches into the cell's circle, else 0.
OccupancyGrid to_grid(const world::World& world, const Frames& frames, double cell_m,
                      std::size_t most_cells);

}  // namespace clew::ros2
