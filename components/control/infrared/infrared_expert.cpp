// SPDX-License-Identifier: Apache-2.0
#include "control/infrared/infrared_expert.hpp"

#include <algorithm>

namespace clew::control {
WheelSpeeds expert_opinion(const InfraredExpertParameters& parameters,
                           const InfraredDistances& distances_m) {
  const auto nearness = [&](InfraredSide side) {
    return std::clamp(
        (parameters.far_m - distances_m[side]) / (parameters.far_m - kNearestReading_m), 0.0, 1.0);
  };
  const double ahead = nearness(kAhead);
  const double more_left = nearness(kLeft) - nearness(kRight);
  return {parameters.cruise_mps - (parameters.cruise_mps + parameters.turn_mps) * ahead +
              parameters.side_mps * std::max(0.0, more_left),
          parameters.cruise_mps - (parameters.cruise_mps - parameters.turn_mps) * ahead +
              parameters.side_mps * std::max(0.0, -more_left)};
}

core::Result<std::unique_ptr<InfraredExpert>> InfraredExpert::create(
    const Parameters& parameters, const domain::BehaviourSetup& setup) {
  const auto infrareds = FourInfrareds::create(setup.scan, "infrared_expert");
  if (!infrareds.ok()) return infrareds.error();
  return std::make_unique<InfraredExpert>(parameters, *infrareds);
}

domain::Motion InfraredExpert::step(const domain::Odometry& odometry, const domain::Scan& scan,
                                    const core::Vec2& target_odom) {
  const double target_rad = core::bearing_rad(odometry.pose_odom_robot, target_odom);
  const InfraredDistances distances_m = infrareds_.distances_m(scan);
  return to_motion(expert_opinion(parameters_, distances_m) +
                   target_term(parameters_.target, target_rad, distances_m));
}

}  // namespace clew::control
