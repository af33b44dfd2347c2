// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "domain/messages.hpp"

namespace clew::control {

/// Shortens the readings of `scan` to virtual obstacles that are nearer: the least distance to a
/// box inside each beam, from the skin, exact. A box that holds the robot's centre is ignored, so
/// that the robot can leave it. Boxes and pose in the odometry frame.
void overlay_virtual_obstacles(const domain::Guidance& guidance, const core::Pose2& pose_odom_robot,
                               double radius_m, domain::Scan& scan);

}  // namespace clew::control
