// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "core/result.hpp"
#include "drive/drive_model.hpp"

namespace clew::drive {

struct DifferentialParameters {
  double tick_s = 0.1;
  double wheel_base_m = 0.25;
  double max_wheel_speed_mps = 0.8;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, DifferentialParameters& p) {
  visit.number("tick_s", p.tick_s, "s", {0.01, 10.0},
               "simulated time of a tick, in which a command is active");
  visit.number("wheel_base_m", p.wheel_base_m, "m", {0.01, 5.0}, "distance between the wheels");
  visit.number("max_wheel_speed_mps", p.max_wheel_speed_mps, "m/s", {0.01, 10.0},
               "greatest speed of a wheel, ahead and back");
}

/// Two driven wheels on one axle: Wang, Yang & Meng, eq. 1,
///
///     v = (V_L + V_R) / 2,   omega = (V_R - V_L) / L.
///
/// Commands of other kinds become the wheel speeds of their velocities. Where a wheel would have to
/// turn faster than it can, both are slowed by the same factor: the path keeps its curvature. The
/// paper gives its platform (20 x 25 cm), neither L nor the wheels' fastest speed: ours is twice
/// the largest consequent of its rules, since two rules act on each wheel.
class Differential final : public DriveModel {
 public:
  using Parameters = DifferentialParameters;

  static core::Result<std::unique_ptr<Differential>> create(const Parameters& parameters,
                                                            const domain::BehaviourSetup& setup);

  explicit Differential(const Parameters& parameters) : parameters_(parameters) {}

  double tick_s() const override { return parameters_.tick_s; }
  domain::MotionLimits limits() const override;
  Legs legs(const domain::Motion& motion, const Velocities& before) const override;

 private:
  Parameters parameters_;
};

}  // namespace clew::drive
