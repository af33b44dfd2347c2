// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/parameters.hpp"
#include "drive/actuators.hpp"
#include "drive/body.hpp"
#include "drive/dead_reckoning.hpp"
#include "drive/drive_model.hpp"
#include "drive/referee.hpp"
#include "runtime/component.hpp"
#include "runtime/stage.hpp"

namespace clew::drive {

template <typename Visitor>
void visit_parameters(Visitor& visit, SafetyParameters& p) {
  visit.flag("safety", p.enabled, "whether the safety layer stops the robot short of contact");
  visit.number("safety_margin_m", p.margin_m, "m", {0.0001, 0.1},
               "distance from contact at which it stops the robot");
}

/// Which random numbers are this component's, of those that a seed gives.
inline constexpr std::uint32_t kRandomComponent = 2;

/// The simulated robot: applies the command of the tick before, and tells the truth, what the robot
/// itself knows of it, and what its referee says of the mission.
class DriveComponent final : public runtime::Component {
 public:
  static std::vector<runtime::PortInfo> ports();

  DriveComponent(std::unique_ptr<DriveModel> model, const SafetyParameters& safety,
                 const DriftParameters& drift, const ActuatorParameters& actuators,
                 const ArrivalParameters& arrival, const runtime::RunSetup& setup);

  void step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;
  void tell(const runtime::TickInputs& samples, domain::Inside& inside) const override;

 private:
  void move(const domain::Motion& motion, std::uint64_t tick);
  void tell_motion(const domain::Motion& motion, domain::Inside& inside) const;
  void tell_mission(const core::Vec2& position, domain::Inside& inside) const;
  void tell_belief(domain::Inside& inside) const;
  void write_state(domain::State& state) const;
  void write_odometry(domain::Odometry& odometry) const;

  std::unique_ptr<DriveModel> model_;
  std::shared_ptr<const world::World> world_;
  std::uint64_t seed_;
  std::uint32_t robot_index_;
  bool counts_;  ///< what the wheels made, which is not the truth
  Referee referee_;
  Body body_;
  Actuators actuators_;      // in use if they lag or slip
  DeadReckoning reckoning_;  // in use if it counts
  Velocities before_;        // scratch: how it moved when the last motion began
};

}  // namespace clew::drive
