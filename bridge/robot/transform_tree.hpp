// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>

#include "core/geometry.hpp"
#include "ros2/messages.hpp"

namespace clew::robot {

/// How a laser is mounted on the robot.
struct Mount {
  core::Pose2 pose_robot_laser;
  bool upside_down = false;  ///< its beams then go clockwise
};

/// The frames of /tf and /tf_static.
class TransformTree {
 public:
  /// Takes them in; what is not finite, or turns nothing, is left out.
  void add(const ros2::TFMessage& message);

  /// Where `frame` is in `base`, if the tree connects the two and the frame lies level: a laser
  /// that looks up or down measures no scan of the plane.
  std::optional<Mount> mount(const std::string& base, const std::string& frame) const;

 private:
  struct Edge {
    std::string parent;
    Eigen::Isometry3d pose_parent_child;
  };
  /// The place of a frame in the topmost one above it, whose name is written to `frame`.
  Eigen::Isometry3d climb(std::string& frame) const;

  std::map<std::string, Edge> edges_;  ///< by child
};

}  // namespace clew::robot
