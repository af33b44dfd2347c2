// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "domain/messages.hpp"
#include "domain/motion_conversion.hpp"
#include "robot/latest.hpp"
#include "robot/settings.hpp"
#include "robot/transform_tree.hpp"
#include "ros2/node.hpp"
#include "ros2/robot_inputs.hpp"

namespace clew::robot {

/// What is known of a robot at a moment.
struct RobotView {
  domain::Odometry odometry;
  std::string covariance_fault;  ///< of the robot's odometry; empty: none
  double odometry_age_s = 0.0;
  ros2::LaserScan scan;  ///< beams as if the laser stood upright
  double scan_age_s = 0.0;
  core::Pose2 pose_robot_laser;
  /// Where the robot was when the scan was measured, as far as its odometry reaches.
  std::optional<core::Pose2> pose_odom_at_scan;

  /// Where the laser was when it measured the scan, in the frame of a robot that is at
  /// `pose_odom_robot` by now.
  core::Pose2 laser_seen_from(const core::Pose2& pose_odom_robot) const;
};

/// A robot of ROS 2: a node that listens to /scan, /odom, /tf and /tf_static, and writes /cmd_vel.
/// The last command that it writes is to stand still, however the process ends that can still
/// write. From the first command on, a robot that is commanded nothing for `timeout_s`, or for two
/// ticks if that is longer, is told to stand still: the run is paused, or hangs.
class RobotLink {
 public:
  /// `origin` is the run's: samples that come from it do not come back.
  static core::Result<std::unique_ptr<RobotLink>> create(const Settings& settings,
                                                         const std::string& origin, double tick_s);
  ~RobotLink();
  RobotLink(const RobotLink&) = delete;
  RobotLink& operator=(const RobotLink&) = delete;

  /// Waits for the first scan and odometry, for where the laser is, and for somebody who reads
  /// commands. An error says what is missing.
  core::Result<void> wait_until_there(Time deadline) const;
  /// After wait_until_there().
  RobotView look(Time now) const;
  void command(const domain::Velocities& velocities, Time now);
  /// The last command: from now on none is another. It is said more than once, since whoever says
  /// it may be gone before a lost sample is asked for again.
  void stand_still();

  const Settings& settings() const { return settings_; }

 private:
  template <typename Message>
  class Inlet;

  RobotLink(const Settings& settings, double patience_s);
  core::Result<void> open();
  void take(ros2::LaserScan scan, const std::string& writer, Time now);
  void take(ros2::Odometry odometry, const std::string& writer, Time now);
  void take(const ros2::TFMessage& transforms, const std::string& writer, Time now);
  void publish(const domain::Velocities& velocities, Time now);
  /// Where a laser is, as far as that is known.
  std::optional<Mount> mount_of(const std::string& frame) const;
  void note_mount();
  void watch();
  std::string missing() const;
  std::optional<core::Pose2> pose_at(double stamp_s) const;

  const Settings settings_;
  const double patience_s_;   ///< with whoever commands
  mutable std::mutex mutex_;  ///< of what follows; samples come on the vendor's threads
  Latest<ros2::LaserScan> scan_;
  Latest<ros2::Odometry> odometry_message_;
  ros2::OdometryInput odometry_input_;
  domain::Odometry odometry_;
  std::deque<std::pair<double, core::Pose2>> past_;  ///< poses by their stamps, the oldest first
  TransformTree transforms_;
  std::optional<Mount> mount_;     ///< of the laser of the newest scan
  std::optional<Time> commanded_;  ///< last
  bool stands_still_ = false;
  bool ends_ = false;
  std::condition_variable ending_;

  std::unique_ptr<ros2::Node> node_;
  std::optional<ros2::Publisher<ros2::Twist>> twist_;
  std::optional<ros2::Publisher<ros2::TwistStamped>> twist_stamped_;
  std::vector<std::unique_ptr<bridge::SampleListener>> listeners_;
  std::vector<std::unique_ptr<bridge::SampleReader>> readers_;  ///< closed first
  std::thread watchdog_;
};

}  // namespace clew::robot
