// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "core/angle.hpp"
#include "core/result.hpp"
#include "drive/drive_model.hpp"

namespace clew::drive {

struct UnicycleParameters {
  double tick_s = 0.1;
  double max_speed_mps = 0.6096;
  double max_turn_rate_radps = core::radians(45.0);
  double max_acceleration_mps2 = 0.5;
  double max_turn_acceleration_radps2 = core::radians(90.0);
};

template <typename Visitor>
void visit_parameters(Visitor& visit, UnicycleParameters& p) {
  visit.number("tick_s", p.tick_s, "s", {0.01, 10.0},
               "simulated time of a tick, in which a command is active");
  visit.number("max_speed_mps", p.max_speed_mps, "m/s", {0.01, 10.0},
               "greatest speed, ahead and back");
  visit.number("max_turn_rate_radps", p.max_turn_rate_radps, "rad/s", {0.01, 20.0},
               "greatest turn rate");
  visit.number("max_acceleration_mps2", p.max_acceleration_mps2, "m/s^2", {0.01, 100.0},
               "greatest acceleration");
  visit.number("max_turn_acceleration_radps2", p.max_turn_acceleration_radps2, "rad/s^2",
               {0.01, 100.0}, "greatest turn acceleration");
}

/// A unicycle with limited velocities and accelerations. The defaults are the Nomad 200's of
/// Lagoudakis & Maida 1999, Results: 24 in/s and 45 deg/s; the paper gives no accelerations, ours
/// are 0.5 m/s^2 and 90 deg/s^2.
///
/// Where a command asks for more than the drive's velocities, both are cut by the same factor: the
/// path keeps its curvature and takes longer. Then each changes by at most its acceleration times
/// the tick, and is constant during the tick, so the robot goes along an arc of a circle.
class Unicycle final : public DriveModel {
 public:
  using Parameters = UnicycleParameters;

  static core::Result<std::unique_ptr<Unicycle>> create(const Parameters& parameters,
                                                        const domain::BehaviourSetup& setup);

  Unicycle(const Parameters& parameters, double wheel_base_m)
      : parameters_(parameters), wheel_base_m_(wheel_base_m) {}

  double tick_s() const override { return parameters_.tick_s; }
  domain::MotionLimits limits() const override;
  Legs legs(const domain::Motion& motion, const Velocities& before) const override;

 private:
  Parameters parameters_;
  double wheel_base_m_;  // of commands in wheel speeds: the robot's diameter
};

}  // namespace clew::drive
