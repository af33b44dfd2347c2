// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "domain/setup.hpp"
#include "robot/robot_link.hpp"
#include "runtime/component.hpp"

namespace clew::robot {

/// A robot's laser in the place of *sense*: each tick its newest scan, as the sensor of the graph
/// would have measured it. What the robot has moved since the scan is taken into account, as far as
/// its odometry says.
class RobotSense final : public runtime::Component {
 public:
  RobotSense(std::shared_ptr<RobotLink> link, const domain::ScanLayout& layout, double radius_m);

  void step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) override;
  void save(core::StateWriter& /*writer*/) const override {}
  void load(core::StateReader& /*reader*/) override {}

 private:
  const std::shared_ptr<RobotLink> link_;
  const domain::ScanLayout layout_;
  const double radius_m_;
};

/// Where `pose` is in the frame of `base`, both given in one and the same frame.
core::Pose2 relative_to(const core::Pose2& base, const core::Pose2& pose);
/// Where `pose`, given in the frame of `base`, is in the frame that `base` is given in.
core::Pose2 placed_on(const core::Pose2& base, const core::Pose2& pose);

}  // namespace clew::robot
