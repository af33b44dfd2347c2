// SPDX-License-Identifier: Apache-2.0
#include "robot/robot_sense.hpp"

#include <utility>

#include "core/angle.hpp"
#include "core/math.hpp"

namespace clew::robot {

core::Pose2 relative_to(const core::Pose2& base, const core::Pose2& pose) {
  const double c = core::cos(base.heading_rad);
  const double s = core::sin(base.heading_rad);
  const core::Vec2 way = pose.position() - base.position();
  return {c * way.x() + s * way.y(), c * way.y() - s * way.x(),
          core::wrap_angle_rad(pose.heading_rad - base.heading_rad)};
}

core::Pose2 placed_on(const core::Pose2& base, const core::Pose2& pose) {
  const double c = core::cos(base.heading_rad);
  const double s = core::sin(base.heading_rad);
  return {base.x_m + c * pose.x_m - s * pose.y_m, base.y_m + s * pose.x_m + c * pose.y_m,
          core::wrap_angle_rad(base.heading_rad + pose.heading_rad)};
}

RobotSense::RobotSense(std::shared_ptr<RobotLink> link, const domain::ScanLayout& layout,
                       double radius_m)
    : link_(std::move(link)), layout_(layout), radius_m_(radius_m) {}

void RobotSense::step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) {
  const RobotView view = link_->look(Time::clock::now());
  core::Pose2 laser = view.pose_robot_laser;
  if (view.pose_odom_at_scan) {
    const core::Pose2& now = inputs.get<domain::State>().pose_world_robot;
    laser = placed_on(relative_to(now, *view.pose_odom_at_scan), laser);
  }
  auto& scan = outputs.get<domain::Scan>();
  const domain::TickStamp stamp = scan.stamp;
  scan = ros2::to_scan(view.scan, laser, layout_, radius_m_).value();
  scan.stamp = stamp;
}

}  // namespace clew::robot
