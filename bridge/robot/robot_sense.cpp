// SPDX-License-Identifier: Apache-2.0
#include "robot/robot_sense.hpp"

#include <utility>

namespace clew::robot {

RobotSense::RobotSense(std::shared_ptr<RobotLink> link, const domain::ScanLayout& layout,
                       double radius_m)
    : link_(std::move(link)), layout_(layout), radius_m_(radius_m) {}

void RobotSense::step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) {
  const RobotView view = link_->look(Time::clock::now());
  const core::Pose2& robot = inputs.get<domain::State>().pose_world_robot;
  const core::Pose2 laser = view.laser_seen_from(robot);
  auto& scan = outputs.get<domain::Scan>();
  const domain::TickStamp stamp = scan.stamp;
  scan = ros2::to_scan(view.scan, laser, layout_, radius_m_).value();
  scan.stamp = stamp;
}

}  // namespace clew::robot
