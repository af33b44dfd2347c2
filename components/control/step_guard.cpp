// SPDX-License-Identifier: Apache-2.0
#include "control/step_guard.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "domain/motion_conversion.hpp"
#include "scan/nearest_return.hpp"

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

/// What is left of a motion that was asked for, which is a turn and step: velocities, unless a turn
/// and step was asked for.
domain::Motion in_kind_of(const domain::Motion& asked, const domain::Motion& limited, double tick_s,
                          double wheel_base_m) {
  if (asked.kind == domain::CommandKind::kTurnAndStep) return limited;
  const domain::Velocities velocities = domain::to_velocities(limited, tick_s, wheel_base_m);
  domain::Motion motion;
  motion.kind = domain::CommandKind::kVelocities;
  motion.speed_mps = velocities.speed_mps;
  motion.turn_rate_radps = velocities.turn_rate_radps;
  return motion;
}

}  // namespace

domain::Motion StepGuard::limit(const domain::Motion& motion, const domain::Odometry& odometry,
                                const domain::Scan& scan, Steers steers) {
  keep_contacts(odometry);
  Needs needs{parameters_.margin_m, parameters_.least_step_m};
  if (const auto left = cut(motion, odometry, scan, needs)) return *left;
  if (steers == Steers::kLed && parameters_.led_margin_m < needs.margin_m) {
    needs.margin_m = parameters_.led_margin_m;
    if (const auto left = cut(motion, odometry, scan, needs)) return *left;
  }
  if (state_.turning_side == 0) {
    state_.turning_side = nearest_bearing_rad(odometry, scan) > 0.0 ? -1 : 1;
  }
  const double wheel_base_m = 2.0 * radius_m_;
  domain::Motion turn = domain::to_turn_and_step(motion, tick_s_, wheel_base_m);
  turn.step_m = 0.0;
  turn.turn_rad = state_.turning_side * parameters_.turn_away_rad;
  return in_kind_of(motion, turn, tick_s_, wheel_base_m);
}

std::optional<domain::Motion> StepGuard::cut_step(const domain::Motion& motion,
                                                  const domain::Odometry& odometry,
                                                  const domain::Scan& scan, const Needs& needs) {
  keep_contacts(odometry);
  return cut(motion, odometry, scan, needs);
}

std::optional<domain::Motion> StepGuard::cut(const domain::Motion& motion,
                                             const domain::Odometry& odometry,
                                             const domain::Scan& scan, const Needs& needs) {
  const double wheel_base_m = 2.0 * radius_m_;
  const domain::Motion asked = domain::to_turn_and_step(motion, tick_s_, wheel_base_m);
  if (!parameters_.enabled || asked.step_m <= 0.0) return motion;
  const double most_rad = limits_.turn_rate_radps * tick_s_;
  const double turn_rad = std::clamp(asked.turn_rad, -most_rad, most_rad);
  const double wanted_m = stopping_m(asked.step_m);
  const double free = free_m(turn_rad, wanted_m, needs.margin_m, odometry, scan);
  domain::Motion limited = asked;
  if (free < wanted_m) limited.step_m = std::min(asked.step_m, step_that_stops_within_m(free));
  if (limited.step_m < std::min(asked.step_m, needs.least_step_m)) return std::nullopt;
  state_.turning_side = 0;
  return limited.step_m < asked.step_m ? in_kind_of(motion, limited, tick_s_, wheel_base_m)
                                       : motion;
}

/// The way of a tick and of braking after it.
double StepGuard::stopping_m(double step_m) const {
  const double speed_mps = std::min(step_m / tick_s_, limits_.speed_mps);
  return speed_mps * tick_s_ + 0.5 * speed_mps * speed_mps / limits_.acceleration_mps2;
}

/// The inverse: v T + v^2 / (2 a) = free, solved for v T.
double StepGuard::step_that_stops_within_m(double free_m) const {
  if (std::isinf(limits_.acceleration_mps2)) return free_m;
  const double change_mps = limits_.acceleration_mps2 * tick_s_;
  return tick_s_ * (std::sqrt(change_mps * change_mps + 2.0 * limits_.acceleration_mps2 * free_m) -
                    change_mps);
}

void StepGuard::keep_contacts(const domain::Odometry& odometry) {
  if (odometry.travel_m != state_.travel_m) state_.contacts_odom_rad.clear();
  state_.travel_m = odometry.travel_m;
  for (const double bearing_rad : odometry.contact_bearings_rad) {
    if (state_.contacts_odom_rad.full()) break;
    state_.contacts_odom_rad.push_back(odometry.pose_odom_robot.heading_rad + bearing_rad);
  }
}

/// How far the robot may go after a turn, as far as beams and contacts tell, at most wanted_m.
double StepGuard::free_m(double turn_rad, double wanted_m, double margin_m,
                         const domain::Odometry& odometry, const domain::Scan& scan) const {
  const double rho_m = radius_m_ + margin_m;
  double free_m = wanted_m;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double reading_m = scan.ranges_m[i];
    // Most beams of a laser see nothing that is near enough to matter, whichever way they look.
    if (reading_m >= scan.range_max_m || reading_m - margin_m >= free_m) continue;
    const double distance_m = (reading_m > scan.range_min_m ? reading_m : 0.0) + radius_m_;
    const double off_axis_rad = std::fabs(core::wrap_angle_rad(scan.bearing_rad(i) - turn_rad));
    const double angle_rad = std::max(0.0, off_axis_rad - 0.5 * scan.beam_width_rad);
    free_m = std::min(free_m, free_before_point_m(distance_m, angle_rad, rho_m));
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
  return scan::nearest_return(scan).bearing_rad;
}

}  // namespace clew::control
