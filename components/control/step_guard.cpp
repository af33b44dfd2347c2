// SPDX-License-Identifier: Apache-2.0
#include "control/step_guard.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clew::control {
namespace {

/// How far a disc of radius rho_m may move before it touches a point at distance_m from its centre,
/// angle_rad off its way.
double free_before_point_m(double distance_m, double angle_rad, double rho_m) {
  const double ahead_m = distance_m * core::cos(angle_rad);
  const double beside_m = distance_m * core::sin(angle_rad);
  if (ahead_m <= 0.0 || std::fabs(beside_m) >= rho_m) return std::numeric_limits<double>::max();
  return std::max(0.0, ahead_m - std::sqrt(rho_m * rho_m - beside_m * beside_m));
}

}  // namespace

domain::Motion StepGuard::limit(const domain::Motion& motion, const domain::Odometry& odometry,
                                const domain::Scan& scan) {
  keep_contacts(odometry);
  if (!parameters_.enabled || motion.kind != domain::CommandKind::kTurnAndStep ||
      motion.step_m <= 0.0) {
    return motion;
  }
  domain::Motion limited = motion;
  limited.step_m = std::min(motion.step_m, free_m(motion.turn_rad, odometry, scan));
  if (limited.step_m >= std::min(motion.step_m, parameters_.least_step_m)) {
    state_.turning_side = 0;
    return limited;
  }
  if (state_.turning_side == 0) {
    state_.turning_side = nearest_bearing_rad(odometry, scan) > 0.0 ? -1 : 1;
  }
  limited.step_m = 0.0;
  limited.turn_rad = state_.turning_side * parameters_.turn_away_rad;
  return limited;
}

void StepGuard::keep_contacts(const domain::Odometry& odometry) {
  if (odometry.travel_m != state_.travel_m) state_.contacts_odom_rad.clear();
  state_.travel_m = odometry.travel_m;
  for (const double bearing_rad : odometry.contact_bearings_rad) {
    if (state_.contacts_odom_rad.full()) break;
    state_.contacts_odom_rad.push_back(odometry.pose_odom_robot.heading_rad + bearing_rad);
  }
}

/// How far the robot may go after a turn, as far as cones and contacts tell.
double StepGuard::free_m(double turn_rad, const domain::Odometry& odometry,
                         const domain::Scan& scan) const {
  const double rho_m = radius_m_ + parameters_.margin_m;
  double free_m = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (scan.ranges_m[i] >= scan.range_max_m) continue;
    const double off_axis_rad = std::fabs(core::wrap_angle_rad(scan.bearing_rad(i) - turn_rad));
    const double angle_rad = std::max(0.0, off_axis_rad - 0.5 * scan.beam_width_rad);
    free_m = std::min(free_m, free_before_point_m(scan.ranges_m[i] + radius_m_, angle_rad, rho_m));
  }
  const double way_odom_rad = odometry.pose_odom_robot.heading_rad + turn_rad;
  for (const double contact_rad : state_.contacts_odom_rad) {
    free_m = std::min(free_m, free_before_point_m(radius_m_, contact_rad - way_odom_rad, rho_m));
  }
  return free_m;
}

/// Where the nearest return is: the first contact, which has no distance, or the shortest reading.
double StepGuard::nearest_bearing_rad(const domain::Odometry& odometry,
                                      const domain::Scan& scan) const {
  if (!state_.contacts_odom_rad.empty()) {
    return core::wrap_angle_rad(state_.contacts_odom_rad[0] - odometry.pose_odom_robot.heading_rad);
  }
  const auto shortest = std::min_element(scan.ranges_m.begin(), scan.ranges_m.end());
  return scan.bearing_rad(static_cast<std::size_t>(shortest - scan.ranges_m.begin()));
}

}  // namespace clew::control
