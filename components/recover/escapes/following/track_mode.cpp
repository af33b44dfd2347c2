// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/following/track_mode.hpp"

#include "core/angle.hpp"
#include "recover/escapes/following/flanks.hpp"

namespace clew::recover {

core::Result<std::unique_ptr<TrackMode>> TrackMode::create(const Parameters& parameters,
                                                           const domain::BehaviourSetup& setup) {
  CLEW_RETURN_IF_ERROR(scan::SevenCones::check(setup.scan, "track_mode"));
  const auto resource = setup.resources.find("rulebases", parameters.rules);
  if (!resource.ok()) return resource.error();
  const auto rules = WallRules::parse(*resource);
  if (!rules.ok()) return rules.error();
  return std::make_unique<TrackMode>(parameters, *rules);
}

void TrackMode::begin(const Situation& all, const TrapEvidence&) {
  const Situation situation = all.with(eyes_.see(all.scan));
  const Side target = side_of(situation.target_bearing_rad());
  const bool sees = follower_.sees_obstacle(situation.scan);
  state_ = {};
  state_.wall = sees ? obstacle_side(situation) : target;
  begin_tracking(situation);
}

void TrackMode::begin_tracking(const Situation& situation) {
  state_.begun_odom = situation.pose().position();
  state_.off_line = 0.0;
  state_.wall_travel_m = situation.odometry.travel_m;
  loop_.begin(situation.pose(), situation.odometry.travel_m, situation.target_odom);
}

EscapeStatus TrackMode::step(const Situation& all, domain::Guidance& guidance) {
  const Situation situation = all.with(eyes_.see(all.scan));
  const double travel_m = situation.odometry.travel_m;
  const bool at_end = follower_.at_break(situation.scan, state_.wall);
  if (!at_end && !state_.at_wall) {
    state_.at_wall = true;
    begin_tracking(situation);
  }
  if (!at_end) state_.wall_travel_m = travel_m;
  if (state_.at_wall && may_leave(situation, at_end)) {
    guidance.why = "H mode";
    return EscapeStatus::kEnded;
  }
  if (travel_m - state_.wall_travel_m > parameters_.lost_wall_m) {
    guidance.why = "no wall to track";
    return EscapeStatus::kFailed;
  }
  if (loop_.add(situation.pose(), travel_m, situation.target_odom, false, state_.wall)) {
    guidance.why = "came round";
    return EscapeStatus::kFailed;
  }
  guidance.has_override = true;
  guidance.override_motion = follower_.follow(situation.scan, state_.wall);
  guidance.why = state_.wall == Side::kLeft ? "T mode, wall on left" : "T mode, wall on right";
  return EscapeStatus::kActive;
}

bool TrackMode::may_leave(const Situation& situation, bool at_end) {
  if (parameters_.leave == TrackLeaving::kCollinear) return crosses_line(situation);
  const bool on_wall_side = side_of(situation.target_bearing_rad()) == state_.wall;
  if (!on_wall_side) state_.target_was_off = true;
  return at_end && on_wall_side && state_.target_was_off;
}

/// Whether the robot crosses the line from a to c in this tick, between the two.
bool TrackMode::crosses_line(const Situation& situation) {
  const core::Vec2 way = situation.target_odom - state_.begun_odom;
  const core::Vec2 offset = situation.pose().position() - state_.begun_odom;
  const double before = state_.off_line;
  state_.off_line = way.x() * offset.y() - way.y() * offset.x();
  const bool crossed =
      (before > 0.0 && state_.off_line <= 0.0) || (before < 0.0 && state_.off_line >= 0.0);
  const double along = offset.dot(way);
  return crossed && along > 0.0 && along < way.dot(way);
}

void TrackMode::save(core::StateWriter& writer) const { writer(state_, loop_.state()); }

void TrackMode::load(core::StateReader& reader) {
  reader(state_, loop_.state());
  const bool valid = state_.wall == Side::kLeft || state_.wall == Side::kRight;
  if (!reader.check(valid, "there is no such side")) state_ = {};
}

}  // namespace clew::recover
