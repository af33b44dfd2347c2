// SPDX-License-Identifier: Apache-2.0
#include "drive/body.hpp"

#include <cmath>

namespace clew::drive {

Body::Body(const core::Pose2& start, double radius_m, const SafetyParameters& safety)
    : radius_m_(radius_m), safety_(safety) {
  state_.pose_world_robot = start;
}

void Body::move(const world::World& world, const Legs& legs, double time_s) {
  const double path_before_m = state_.path_length_m;
  const bool struck_before = state_.struck;
  double turn_rad = 0.0;
  bool backwards = false;
  double elapsed_s = 0.0;
  state_.blocked = false;
  state_.struck = false;
  state_.contact_bearings_rad.clear();

  for (Leg leg : legs) {
    if (state_.blocked) leg.step_m = 0.0;
    move_leg(world, leg, time_s + elapsed_s);
    turn_rad += leg.turn_rad + leg.bend_rad;
    backwards = backwards || leg.step_m < 0.0;
    elapsed_s += leg.duration_s;
  }

  const double path_m = state_.path_length_m - path_before_m;
  state_.speed_mps = elapsed_s > 0.0 ? (backwards ? -path_m : path_m) / elapsed_s : 0.0;
  state_.turn_rate_radps = elapsed_s > 0.0 ? turn_rad / elapsed_s : 0.0;
  if (state_.struck && !struck_before) ++state_.hit_by;
  if (state_.blocked) {
    const core::Pose2& pose = state_.pose_world_robot;
    for (const double angle_rad : world.contacts_rad(pose.position(), radius_m_,
                                                     2.0 * safety_.margin_m, time_s + elapsed_s)) {
      state_.contact_bearings_rad.push_back(core::wrap_angle_rad(angle_rad - pose.heading_rad));
    }
  }
}

void Body::move_leg(const world::World& world, const Leg& leg, double time_s) {
  core::Pose2& pose = state_.pose_world_robot;
  pose.heading_rad = core::wrap_angle_rad(pose.heading_rad + leg.turn_rad);
  const Stretch stretch(pose, leg.step_m, leg.bend_rad, time_s, leg.duration_s);

  const double fraction = free_fraction(world, stretch);
  if (!world.moving().empty() && is_struck(world, stretch, fraction)) state_.struck = true;

  const core::Vec2 reached = stretch.at(fraction);
  pose.x_m = reached.x();
  pose.y_m = reached.y();
  pose.heading_rad = core::wrap_angle_rad(pose.heading_rad + leg.bend_rad);
  state_.path_length_m += fraction * std::fabs(leg.step_m);
}

/// How much of the stretch the disc may go; accounts for what stops it.
double Body::free_fraction(const world::World& world, const Stretch& stretch) {
  const double radius_m = radius_m_ + (safety_.enabled ? safety_.margin_m : 0.0);
  const world::Sweep sweep = stretch.sweep(world, radius_m);
  if (!sweep.contact || !stretch.approaches(sweep.contact_point, sweep.free_fraction)) return 1.0;
  auto& contacts = safety_.enabled ? state_.safety_stops : state_.collisions;
  if (!state_.blocked) ++contacts;
  state_.blocked = true;
  return sweep.free_fraction;
}

/// Whether a moving obstacle runs into the disc, while it goes or while it stands afterwards.
bool Body::is_struck(const world::World& world, const Stretch& stretch, double fraction) const {
  const Stretch gone = stretch.until(fraction);
  const world::Sweep going = gone.sweep(world, radius_m_);
  if (going.contact && going.moving_obstacle) {
    return !stretch.approaches(going.contact_point, fraction * going.free_fraction);
  }
  const core::Vec2 reached = stretch.at(fraction);
  const world::Sweep standing =
      world.sweep_disc(reached, reached, radius_m_, stretch.time_s() + gone.duration_s(),
                       stretch.duration_s() - gone.duration_s());
  return standing.contact && standing.moving_obstacle;
}

}  // namespace clew::drive
