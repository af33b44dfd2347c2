// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "core/angle.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "drive/drive_model.hpp"

namespace clew::drive {

struct TurnThenStepParameters {
  double tick_s = 0.3;
  double max_turn_rad = core::radians(180.0);
  double max_step_m = 0.15;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, TurnThenStepParameters& p) {
  visit.number("tick_s", p.tick_s, "s", {0.01, 10.0}, "simulated time of a turn and its step");
  visit.angle("max_turn_deg", p.max_turn_rad, {1.0, 180.0}, "greatest turn in a tick");
  visit.number("max_step_m", p.max_step_m, "m", {0.001, 10.0}, "greatest step in a tick");
}

/// Turns on the spot, then steps straight ahead, once a tick: Krishna & Kalra 2000, sections 2.1
/// and 4 (the robot rotates about its centre, and travels s, eq. 8, before it samples again).
///
/// Commands of other kinds are converted: velocities v, omega become a turn of omega tick_s and a
/// step of v tick_s; wheel speeds are v = (l + r) / 2, omega = (r - l) / b first, with the robot's
/// diameter as wheel base b. It does not drive backwards: a negative step is none.
class TurnThenStep final : public DriveModel {
 public:
  using Parameters = TurnThenStepParameters;

  static core::Result<std::unique_ptr<TurnThenStep>> create(const Parameters& parameters,
                                                            const domain::BehaviourSetup& setup);

  TurnThenStep(const Parameters& parameters, double wheel_base_m)
      : parameters_(parameters), wheel_base_m_(wheel_base_m) {}

  double tick_s() const override { return parameters_.tick_s; }
  domain::MotionLimits limits() const override;
  Legs legs(const domain::Motion& motion, const Velocities& before) const override;

 private:
  Parameters parameters_;
  double wheel_base_m_;
};

}  // namespace clew::drive
