// SPDX-License-Identifier: Apache-2.0
#include "drive/body.hpp"

namespace clew::drive {

/// A straight way during an interval of time.
struct Body::Stretch {
  core::Vec2 from;
  core::Vec2 to;
  double time_s;
  double duration_s;

  /// Whether moving along it brings the disc nearer to a point that it touches on the way.
  bool approaches(const core::Vec2& point, double fraction) const {
    const core::Vec2 way = to - from;
    const core::Vec2 there = from + fraction * way;
    return way.dot(point - there) > 0.0;
  }
};

Body::Body(const core::Pose2& start, double radius_m, const SafetyParameters& safety)
    : radius_m_(radius_m), safety_(safety) {
  state_.pose_world_robot = start;
}

void Body::move(const world::World& world, const Legs& legs, double time_s) {
  const double path_before_m = state_.path_length_m;
  const bool struck_before = state_.struck;
  double turn_rad = 0.0;
  double elapsed_s = 0.0;
  state_.blocked = false;
  state_.struck = false;
  state_.contact_bearings_rad.clear();

  for (Leg leg : legs) {
    if (state_.blocked) leg.step_m = 0.0;
    move_leg(world, leg, time_s + elapsed_s);
    turn_rad += leg.turn_rad;
    elapsed_s += leg.duration_s;
  }

  state_.speed_mps = elapsed_s > 0.0 ? (state_.path_length_m - path_before_m) / elapsed_s : 0.0;
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
  const core::Vec2 from = pose.position();
  const Stretch stretch{from, from + leg.step_m * core::direction(pose.heading_rad), time_s,
                        leg.duration_s};

  const double fraction = free_fraction(world, stretch);
  if (!world.moving().empty() && is_struck(world, stretch, fraction)) state_.struck = true;

  const core::Vec2 reached = from + fraction * (stretch.to - from);
  pose.x_m = reached.x();
  pose.y_m = reached.y();
  state_.path_length_m += fraction * leg.step_m;
}

/// How much of the stretch the disc may go; accounts for what stops it.
double Body::free_fraction(const world::World& world, const Stretch& stretch) {
  const double radius_m = radius_m_ + (safety_.enabled ? safety_.margin_m : 0.0);
  const world::Sweep sweep =
      world.sweep_disc(stretch.from, stretch.to, radius_m, stretch.time_s, stretch.duration_s);
  if (!sweep.contact || !stretch.approaches(sweep.contact_point, sweep.free_fraction)) return 1.0;
  if (!state_.blocked) ++(safety_.enabled ? state_.safety_stops : state_.collisions);
  state_.blocked = true;
  return sweep.free_fraction;
}

/// Whether a moving obstacle runs into the disc, while it goes or while it stands afterwards.
bool Body::is_struck(const world::World& world, const Stretch& stretch, double fraction) const {
  const core::Vec2 reached = stretch.from + fraction * (stretch.to - stretch.from);
  const double going_s = fraction * stretch.duration_s;
  const world::Sweep going =
      world.sweep_disc(stretch.from, reached, radius_m_, stretch.time_s, going_s);
  if (going.contact && going.moving_obstacle) {
    return !stretch.approaches(going.contact_point, fraction * going.free_fraction);
  }
  const world::Sweep standing = world.sweep_disc(
      reached, reached, radius_m_, stretch.time_s + going_s, stretch.duration_s - going_s);
  return standing.contact && standing.moving_obstacle;
}

}  // namespace clew::drive
