// SPDX-License-Identifier: Apache-2.0
#include "control/pursuit/regulated_pure_pursuit.hpp"

#include <algorithm>
#include <cmath>

#include "scan/nearest_return.hpp"

namespace clew::control {

core::Result<std::unique_ptr<RegulatedPurePursuit>> RegulatedPurePursuit::create(
    const Parameters& parameters, const domain::BehaviourSetup& setup) {
  if (parameters.least_speed_mps > parameters.speed_mps) {
    return core::Error{
        "control.regulated_pure_pursuit: least_speed_mps must not be greater than "
        "speed_mps"};
  }
  return std::make_unique<RegulatedPurePursuit>(parameters, setup);
}

domain::Motion RegulatedPurePursuit::step(const domain::Odometry& odometry,
                                          const domain::Scan& scan, const core::Vec2& target_odom) {
  const Pursuit pursuit = pursue(odometry, scan, target_odom);
  domain::Motion motion;
  motion.kind = domain::CommandKind::kVelocities;
  if (std::fabs(pursuit.bearing_rad) > parameters_.turn_first_rad) {
    motion.turn_rate_radps = turn_rate_on_spot_radps(pursuit.bearing_rad);
  } else {
    motion.speed_mps = pursuit.chosen_mps;
    motion.turn_rate_radps = pursuit.chosen_mps * pursuit.curvature_per_m;
  }
  return motion;
}

RegulatedPurePursuit::Pursuit RegulatedPurePursuit::pursue(const domain::Odometry& odometry,
                                                           const domain::Scan& scan,
                                                           const core::Vec2& target_odom) const {
  const RegulatedPurePursuitParameters& p = parameters_;
  Pursuit pursuit;
  pursuit.distance_m = core::distance_m(odometry.pose_odom_robot, target_odom);
  if (pursuit.distance_m == 0.0) return pursuit;
  pursuit.bearing_rad = core::bearing_rad(odometry.pose_odom_robot, target_odom);
  pursuit.curvature_per_m = 2.0 * core::sin(pursuit.bearing_rad) / pursuit.distance_m;
  pursuit.speed_mps = std::min(p.speed_mps, limits_.speed_mps);
  const auto regulated = [&](double ratio) { return pursuit.speed_mps * std::min(1.0, ratio); };
  const double curvature_per_m = std::fabs(pursuit.curvature_per_m);
  const double tightness = curvature_per_m * p.curve_radius_m;
  pursuit.in_curve_mps = tightness > 1.0 ? regulated(1.0 / tightness) : pursuit.speed_mps;
  const double nearest_m = scan::nearest_return(scan).range_m;
  pursuit.beside_obstacle_mps =
      p.near_m > 0.0 ? regulated(nearest_m / p.near_m) : pursuit.speed_mps;
  pursuit.before_place_mps =
      p.slow_before_m > 0.0 ? regulated(pursuit.distance_m / p.slow_before_m) : pursuit.speed_mps;
  const double regulated_mps =
      std::min({pursuit.in_curve_mps, pursuit.beside_obstacle_mps, pursuit.before_place_mps});
  pursuit.chosen_mps = std::max(regulated_mps, std::min(p.least_speed_mps, pursuit.speed_mps));
  if (pursuit.chosen_mps * curvature_per_m > most_turn_rate_radps()) {
    pursuit.chosen_mps = most_turn_rate_radps() / curvature_per_m;
  }
  pursuit.chosen_mps = std::min(pursuit.chosen_mps, pursuit.distance_m / tick_s_);
  return pursuit;
}

double RegulatedPurePursuit::most_turn_rate_radps() const {
  return std::min(parameters_.turn_rate_radps, limits_.turn_rate_radps);
}

/// So fast that the turn ends within a tick, or can be slowed down in time: with a deceleration of
/// a that is w T + w^2 / (2 a) = b.
double RegulatedPurePursuit::turn_rate_on_spot_radps(double bearing_rad) const {
  const double turn_rad = std::fabs(bearing_rad);
  double rate_radps = turn_rad / tick_s_;
  if (std::isfinite(limits_.turn_acceleration_radps2)) {
    const double change_radps = limits_.turn_acceleration_radps2 * tick_s_;
    rate_radps =
        std::sqrt(change_radps * change_radps + 2.0 * limits_.turn_acceleration_radps2 * turn_rad) -
        change_radps;
  }
  return std::copysign(std::min(rate_radps, most_turn_rate_radps()), bearing_rad);
}

}  // namespace clew::control
