// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "drive/drive_model.hpp"
#include "drive/referee.hpp"
#include "robot/robot_link.hpp"
#include "runtime/component.hpp"

namespace clew::robot {

/// A robot in the place of *drive*: each tick it is told the command of the tick before, and what
/// its odometry says is odometry and state. The referee judges by the odometry.
///
/// It is told to stand still if the command was late, if its scan or its odometry is older than
/// `timeout_s`, while it has no mission, and when the run ends. It is told not to go on, only to
/// turn, where it would come nearer than `brake_margin_m` to what its scan shows; the tick's
/// odometry then says `blocked`.
class RobotDrive final : public runtime::Component {
 public:
  struct Handlers {
    std::function<void(std::string)> on_notice;
    std::function<void(std::string)> on_fatal;  ///< the run cannot go on
  };

  RobotDrive(std::shared_ptr<RobotLink> link, std::unique_ptr<drive::DriveModel> model,
             const drive::Mission& mission, double radius_m, Handlers handlers);

  void step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  /// What is to be asked of the robot for a tick.
  domain::Velocities velocities_for(const domain::Motion& motion) const;
  /// The same, as far as the scan lets it go ahead.
  domain::Velocities braked(const domain::Velocities& asked, const RobotView& view);
  bool is_heard(const RobotView& view);
  void tell_covariance_fault(const RobotView& view);

  const std::shared_ptr<RobotLink> link_;
  const std::unique_ptr<drive::DriveModel> model_;
  drive::Referee referee_;
  const double radius_m_;
  const Handlers handlers_;

  struct State {
    domain::Velocities told;  ///< last
    bool blocked = false;
    double contact_bearing_rad = 0.0;
    std::uint32_t safety_stops = 0;
  } state_;
  bool was_heard_ = true;
  bool gave_up_ = false;
  bool told_covariance_fault_ = false;
};

}  // namespace clew::robot
