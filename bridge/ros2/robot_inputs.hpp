// SPDX-License-Identifier: Apache-2.0
/// What a robot of ROS 2 tells, as Clew's stages want it.
#pragma once

#include <string>
#include <vector>

#include "core/geometry.hpp"
#include "core/result.hpp"
#include "domain/messages.hpp"
#include "domain/setup.hpp"
#include "ros2/messages.hpp"

namespace clew::ros2 {

double to_seconds(const Time& time);
/// The turn about z of a rotation.
double to_heading_rad(const Quaternion& rotation);
/// Refused: numbers that are not finite, and a rotation of no length.
core::Result<core::Pose2> to_pose2(const Pose& pose);

/// Refused: a scan whose numbers make no fan of beams.
core::Result<void> check_fan(const LaserScan& scan);

/// Whether the laser saw something, or that nothing is there (REP 117: +inf).
bool measured_anything(const LaserScan& scan);

/// Where the laser saw something, in the robot's frame; the scan must be a fan.
std::vector<core::Vec2> returns_of(const LaserScan& scan, const core::Pose2& pose_robot_laser);

/// A laser's scan as the sensor of a graph would have measured it: each beam reads the nearest
/// return within its opening (for a ray, within half a step of the laser's), from the robot's skin.
/// What the laser does not see at all counts as nothing within range, so a sensor should not look
/// where the laser does not.
///
/// pose_robot_laser: where the laser stands in the robot's frame. Refused: a scan whose numbers
/// make no fan.
core::Result<domain::Scan> to_scan(const LaserScan& scan, const core::Pose2& pose_robot_laser,
                                   const domain::ScanLayout& layout, double radius_m);

/// Follows the odometry of a robot: adds up its path.
class OdometryInput {
 public:
  /// Refused: a pose that is none.
  core::Result<domain::Odometry> next(const Odometry& odometry);
  /// What is wrong with the covariance of the last message, with its place; empty: nothing. Such a
  /// covariance is left out, and the pose counts as exact.
  const std::string& covariance_fault() const { return covariance_fault_; }

 private:
  std::string covariance_fault_;
  bool has_previous_ = false;
  core::Pose2 previous_;
  double travel_m_ = 0.0;
};

}  // namespace clew::ros2
