// SPDX-License-Identifier: Apache-2.0
#include "recover/obstacle_following.hpp"

#include <algorithm>
#include <cmath>

namespace clew::recover {
namespace {

std::size_t nearest_beam(const domain::Scan& scan) {
  std::size_t n = 0;
  for (std::size_t i = 1; i < scan.ranges_m.size(); ++i)
    if (scan.ranges_m[i] < scan.ranges_m[n]) n = i;
  return n;
}
double nearest_bearing(const domain::Scan& scan) { return scan.bearing_rad(nearest_beam(scan)); }

}  // namespace

core::Result<std::unique_ptr<ObstacleFollowing>> ObstacleFollowing::create(
    const Parameters& parameters, const domain::BehaviourSetup&) {
  return std::make_unique<ObstacleFollowing>(parameters);
}

void ObstacleFollowing::enter(Phase phase, const Situation& situation) {
  state_.phase = phase;
  state_.phase_travel_m = situation.odometry.travel_m;
  if (phase == Phase::kFollow) {
    state_.wall_seen_travel_m = situation.odometry.travel_m;
    state_.circuit_started = false;
    if (!state_.followed) {
      state_.followed = true;
      state_.start_distance_m = situation.target_distance_m();
      state_.best_distance_m = state_.start_distance_m;
    }
  }
}

void ObstacleFollowing::begin(const Situation& situation, const TrapEvidence&) {
  state_ = {};
  const Side target = side_of(situation.target_bearing_rad());
  double nb = nearest_bearing(situation.scan);
  if (std::fabs(nb) < 0.01) nb = situation.target_bearing_rad();
  const Side obstacle = side_of(nb);
  state_.side = obstacle;
  if (target == obstacle) {
    enter(Phase::kSeek, situation);
  } else {
    turn_about(situation);
  }
}

void ObstacleFollowing::turn_about(const Situation& situation) {
  // turn toward the obstacle, until it is beside the robot on the other side
  const double nb = nearest_bearing(situation.scan);
  const double s = sign(state_.side);
  state_.turn_left_rad = s * (core::kPi / 2 + std::max(0.0, s * nb));
  state_.side = opposite(state_.side);
  enter(Phase::kTurnAbout, situation);
}

EscapeStatus ObstacleFollowing::step(const Situation& situation, domain::Guidance& guidance) {
  if (state_.phase == Phase::kSeek) seek(situation);
  if (state_.phase == Phase::kSeek) {
    guidance.why = "seek";
    return EscapeStatus::kActive;
  }
  if (state_.phase == Phase::kTurnAbout) {
    const double turn = std::clamp(state_.turn_left_rad, -core::radians(30.0), core::radians(30.0));
    state_.turn_left_rad -= turn;
    guidance.has_override = true;
    guidance.override_motion.kind = domain::CommandKind::kTurnAndStep;
    guidance.override_motion.turn_rad = turn;
    guidance.why = "turn about";
    if (std::fabs(state_.turn_left_rad) < 1e-9) enter(Phase::kFollow, situation);
    return EscapeStatus::kActive;
  }
  return follow(situation, guidance);
}

void ObstacleFollowing::seek(const Situation& situation) {
  const auto& u = situation.scan;
  const double nearest = u.ranges_m[nearest_beam(u)] / u.range_max_m;
  const bool in_view = nearest < rules_.break_ratio;
  const Side target = side_of(situation.target_bearing_rad());
  const Side obstacle = side_of(nearest_bearing(u));
  if (in_view && target == obstacle) state_.side = obstacle;
  if (in_view && target != obstacle && obstacle == state_.side)
    enter(Phase::kFollow, situation);
  else if (in_view &&
           situation.odometry.travel_m - state_.phase_travel_m > parameters_.seek_limit_m) {
    state_.side = obstacle;
    enter(Phase::kFollow, situation);
  }
}

bool ObstacleFollowing::may_leave(const Situation& s) const {
  const double range = s.scan.range_max_m;
  const double distance = s.target_distance_m();
  if (distance > state_.start_distance_m - parameters_.nearer_ratio * range) return false;
  const double bearing = s.target_bearing_rad();
  const double half = 0.5 * s.scan.beam_width_rad;
  const double need = std::min(parameters_.clear_ratio * range, distance);
  bool covered = false;
  for (std::size_t i = 0; i < s.scan.ranges_m.size(); ++i) {
    const double off = std::fabs(core::wrap_angle_rad(s.scan.bearing_rad(i) - bearing));
    if (off > half + core::radians(15.0)) continue;
    if (off <= half) covered = true;
    if (s.scan.ranges_m[i] < need) return false;
  }
  return covered;
}

bool ObstacleFollowing::closes_circuit(const Situation& s) {
  const core::Pose2& pose = s.pose();
  if (!state_.circuit_started) {
    if (state_.breaking) return false;
    state_.circuit_started = true;
    state_.circuit_left = false;
    state_.circuit_start = pose.position();
    state_.circuit_heading_rad = pose.heading_rad;
    return false;
  }
  const double away = core::length(pose.position() - state_.circuit_start);
  if (away > 2.0 * parameters_.circuit_radius_m) state_.circuit_left = true;
  return state_.circuit_left && away < parameters_.circuit_radius_m &&
         std::fabs(core::wrap_angle_rad(pose.heading_rad - state_.circuit_heading_rad)) <
             core::radians(60.0);
}

EscapeStatus ObstacleFollowing::follow(const Situation& situation, domain::Guidance& guidance) {
  state_.breaking = at_break(situation.scan, state_.side, rules_);
  if (!state_.breaking) state_.wall_seen_travel_m = situation.odometry.travel_m;
  if (situation.odometry.travel_m - state_.wall_seen_travel_m > parameters_.lost_limit_m) {
    return EscapeStatus::kFailed;
  }
  if (parameters_.leave == LeavingRule::kNearer) {
    if (may_leave(situation)) return EscapeStatus::kEnded;
  } else if (state_.breaking && side_of(situation.target_bearing_rad()) == state_.side) {
    enter(Phase::kSeek, situation);
    guidance.why = "seek";
    return EscapeStatus::kActive;
  }
  if (closes_circuit(situation)) {
    ++state_.circuits;
    if (state_.circuits == 2) return EscapeStatus::kUnreachable;
    turn_about(situation);
    return step(situation, guidance);
  }
  guidance.has_override = true;
  guidance.override_motion = follow_wall(situation.scan, state_.side, rules_);
  guidance.why = state_.side == Side::kLeft ? "wall left" : "wall right";
  return EscapeStatus::kActive;
}

void ObstacleFollowing::save(core::StateWriter& writer) const {
  State state = state_;
  writer(state);
}

void ObstacleFollowing::load(core::StateReader& reader) { reader(state_); }

}  // namespace clew::recover
