// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/right_of_way.hpp"

#include <cmath>
#include <string>

#include "core/angle.hpp"
#include "domain/words.hpp"

namespace clew::recover {

/// Notes the way that the robot comes. An escape that was cut off, since the goal was taken away,
/// is at work no more.
void RightOfWay::watch(const Situation& situation) {
  if (state_.phase != Phase::kNone && situation.tick > state_.tick + 1) state_.phase = Phase::kNone;
  if (state_.phase != Phase::kNone) return;
  auto& trail = state_.trail_odom;
  const core::Vec2 here = situation.pose().position();
  if (!trail.empty() &&
      core::length(trail[trail.size() - 1].position() - here) < parameters_.trail_spacing_m)
    return;
  if (trail.full()) {
    const std::size_t half = kTrailPoints / 2;
    for (std::size_t i = half; i < kTrailPoints; ++i) trail[i - half] = trail[i];
    trail.resize(kTrailPoints - half);
  }
  trail.push_back({here.x(), here.y()});
}

void RightOfWay::begin(const Situation& situation, const TrapEvidence&) {
  state_.tick = situation.tick;
  state_.begin_travel_m = situation.odometry.travel_m;
  begin_phase(Phase::kBack, situation);
}

void RightOfWay::begin_phase(Phase phase, const Situation& situation) {
  state_.phase = phase;
  state_.phase_tick = situation.tick;
  state_.progress_tick = situation.tick;
  state_.progress_odom = situation.pose().position();
}

EscapeStatus RightOfWay::step(const Situation& situation, domain::Guidance& guidance) {
  state_.tick = situation.tick;
  const auto end = [this] {
    state_.phase = Phase::kNone;
    return EscapeStatus::kEnded;
  };
  if (robot_index_ == 0) return end();
  if (state_.phase == Phase::kBack) go_back(situation);
  if (state_.phase == Phase::kAside) {
    const bool there = core::distance_m(situation.pose(), state_.goal_odom) <= parameters_.reach_m;
    // Who has come to stand there makes it go round and round.
    const double gone_m = situation.odometry.travel_m - state_.begin_travel_m;
    const bool too_far =
        gone_m >= parameters_.most_back_m + 2.0 * (parameters_.aside_m + parameters_.reach_m);
    if (there || too_far || is_stuck(situation)) begin_phase(Phase::kHold, situation);
  }
  if (state_.phase == Phase::kHold) {
    if (elapsed_s(situation) >= hold_s()) return end();
    guidance.why = "holds: others have the way";
    guidance.has_override = true;
    guidance.override_motion.kind = domain::CommandKind::kStop;
    return EscapeStatus::kActive;
  }
  const bool back = state_.phase == Phase::kBack;
  const core::Vec2 goal =
      back ? state_.trail_odom[state_.trail_odom.size() - 1].position() : state_.goal_odom;
  guidance.why = back ? "goes back: others have the way" : "goes aside: others have the way";
  guidance.target_x_m = goal.x();
  guidance.target_y_m = goal.y();
  guidance.target_is_virtual = true;
  return EscapeStatus::kActive;
}

/// Takes the last place of the trail that is not reached yet, or goes on with another phase.
void RightOfWay::go_back(const Situation& situation) {
  auto& trail = state_.trail_odom;
  while (!trail.empty() && core::distance_m(situation.pose(), trail[trail.size() - 1].position()) <=
                               parameters_.reach_m) {
    trail.resize(trail.size() - 1);
  }
  const double back_m = situation.odometry.travel_m - state_.begin_travel_m;
  if (back_m >= parameters_.back_m && find_room_aside(situation)) {
    begin_phase(Phase::kAside, situation);
  } else if (trail.empty() || back_m >= parameters_.most_back_m || is_stuck(situation)) {
    begin_phase(Phase::kHold, situation);
  }
}

bool RightOfWay::find_room_aside(const Situation& situation) {
  for (const double aside_rad :
       {parameters_.aside_rad, parameters_.second_aside_rad, parameters_.third_aside_rad}) {
    for (const double side : {1.0, -1.0}) {
      const double bearing_rad = side * aside_rad;
      if (!is_free(situation.scan, bearing_rad)) continue;
      const core::Pose2& pose = situation.pose();
      state_.goal_odom = pose.position() + (parameters_.aside_m + parameters_.reach_m) *
                                               core::direction(pose.heading_rad + bearing_rad);
      return true;
    }
  }
  return false;
}

/// Whether the body may go aside that way, as far as the scan shows.
bool RightOfWay::is_free(const domain::Scan& scan, double bearing_rad) const {
  const double beside_m = radius_m_ + parameters_.clearance_m;
  const double ahead_m = parameters_.aside_m + parameters_.reach_m + beside_m;
  if (scan.range_max_m + radius_m_ < ahead_m) return false;  // it does not show so much
  bool in_view = false;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double angle_rad = core::wrap_angle_rad(scan.bearing_rad(i) - bearing_rad);
    in_view = in_view || std::fabs(angle_rad) <= std::fabs(scan.bearing_step_rad);
    const core::Vec2 hit = (scan.ranges_m[i] + radius_m_) * core::direction(angle_rad);
    const bool returned = scan.ranges_m[i] < scan.range_max_m;
    if (returned && hit.x() > 0.0 && hit.x() < ahead_m && std::fabs(hit.y()) < beside_m) {
      return false;
    }
  }
  return in_view;
}

bool RightOfWay::is_stuck(const Situation& situation) {
  if (core::distance_m(situation.pose(), state_.progress_odom) >= parameters_.progress_m) {
    state_.progress_odom = situation.pose().position();
    state_.progress_tick = situation.tick;
  }
  return static_cast<double>(situation.tick - state_.progress_tick) * tick_s_ >=
         parameters_.stuck_s;
}

void RightOfWay::tell(const Situation& situation, domain::Inside& inside) const {
  static constexpr const char* kPhases[] = {"none", "back", "aside", "hold"};
  const char* phase = kPhases[static_cast<std::size_t>(state_.phase)];
  inside.values.number("robot_index", static_cast<double>(robot_index_));
  inside.values.text("phase", phase);
  inside.values.number("elapsed", elapsed_s(situation), "s");
  inside.values.number("hold", hold_s(), "s");
  inside.values.number("trail_points", static_cast<double>(state_.trail_odom.size()));
  if (robot_index_ == 0) {
    inside.say("This is robot 0, which has the way before all others.");
    return;
  }
  inside.say("Robot " + std::to_string(robot_index_) + " gives way to lower ones, phase " + phase +
             ", which began " + domain::say_seconds(elapsed_s(situation)) + " ago; it holds for " +
             domain::say_seconds(hold_s()) + '.');
}

void RightOfWay::save(core::StateWriter& writer) const { writer(state_); }

void RightOfWay::load(core::StateReader& reader) {
  reader(state_);
  const bool good = reader.check(state_.phase <= Phase::kHold, "there is no such phase") &&
                    reader.check(state_.phase != Phase::kBack || !state_.trail_odom.empty(),
                                 "there is no way back");
  if (!good) state_ = {};
}

}  // namespace clew::recover
