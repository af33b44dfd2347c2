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

}  // namespace clew::robot
