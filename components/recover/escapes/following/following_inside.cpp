// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/fuzzy.hpp"
#include "domain/words.hpp"
#include "recover/escapes/following/obstacle_following.hpp"
#include "recover/escapes/following/track_mode.hpp"

namespace clew::recover {
namespace {

const char* say_side(Side side) { return side == Side::kLeft ? "left" : "right"; }

}  // namespace

void WallFollower::tell(const domain::Scan& scan, Side side, domain::Inside& inside) const {
  const std::size_t outermost = side == Side::kLeft ? 0 : kBeams - 1;
  const double u_side = scan.ranges_m[outermost] / scan.range_max_m;
  const double u_front =
      std::min({scan.ranges_m[2], scan.ranges_m[3], scan.ranges_m[4]}) / scan.range_max_m;
  const double blocked =
      core::falling_membership(u_front, rules_.blocked_full_ratio, rules_.blocked_none_ratio);
  const double close = core::falling_membership(u_side, rules_.close_ratio, rules_.good_ratio);
  const double far = 1.0 - core::falling_membership(u_side, rules_.good_ratio, rules_.far_ratio);
  domain::InsideGroup& rules = inside.values.group("wall_rules");
  rules.number("side_of_range", u_side);
  rules.number("front_of_range", u_front);
  rules.flag("at_break", at_break(scan, side));
  domain::InsideGroup& strengths = rules.group("strengths");
  strengths.number("blocked", blocked);
  strengths.number("close", (1.0 - blocked) * close);
  strengths.number("good", (1.0 - blocked) * (1.0 - close - far));
  strengths.number("far", (1.0 - blocked) * far);
  inside.say("The way ahead is blocked to " + domain::say_percent(blocked) +
             "; the wall is too close to " + domain::say_percent(close) + " and too far to " +
             domain::say_percent(far) + ".");
}

void ObstacleFollowing::tell(const Situation& situation, domain::Inside& inside) const {
  static constexpr const char* kPhases[] = {"seek", "turn about", "follow"};
  const char* phase = kPhases[static_cast<std::size_t>(state_.phase)];
  const double travel_m = situation.odometry.travel_m;
  const double in_phase_m = travel_m - state_.phase_travel_m;
  inside.values.text("phase", phase);
  inside.values.number("path_in_phase", in_phase_m, "m");
  inside.values.text("wall", say_side(state_.wall));
  inside.values.flag("has_followed", state_.followed);
  inside.values.number("leaves_below", state_.leave_below_m, "m");
  inside.values.bound("left_last_at", state_.last_leave_m, "m");
  inside.values.number("turn_left_to_make", state_.turn_left_rad, "rad");
  switch (state_.phase) {
    case Phase::kSeek:
      inside.say("It is in step 1: the controller seeks the target, for " +
                 domain::say_metres(in_phase_m) + " so far.");
      return;
    case Phase::kTurnAbout:
      inside.say("It turns about, by " + domain::say_degrees(state_.turn_left_rad) + " more.");
      return;
    case Phase::kFollow:
      inside.say("It follows the obstacle on the " + std::string(say_side(state_.wall)) + ", for " +
                 domain::say_metres(in_phase_m) + " so far, and leaves where it is nearer to the " +
                 "target than " + domain::say_metres(std::max(0.0, state_.leave_below_m)) +
                 " and the way there is clear.");
      break;
  }
  scan::SevenCones eyes = eyes_;
  follower().tell(eyes.see(situation.scan), state_.wall, inside);
  tell_circuit(situation, inside);
}

/// The circuit along the obstacle, and what it has shown so far.
void ObstacleFollowing::tell_circuit(const Situation& situation, domain::Inside& inside) const {
  const LoopClosure::State& loop = loop_.state();
  domain::InsideGroup& circuit = inside.values.group("circuit");
  circuit.place("anchor", loop.anchor_odom.position());
  circuit.number("from_anchor", core::distance_m(situation.pose(), loop.anchor_odom.position()),
                 "m");
  circuit.number("path_since_anchor", situation.odometry.travel_m - loop.anchor_travel_m, "m");
  circuit.number("turned", loop.turned_rad, "rad");
  circuit.number("target_wound", loop.wound_rad, "rad");
  circuit.bound("nearest_clear", loop.nearest_clear_m, "m");
  circuit.flag("closed_once", state_.came_round);
  circuit.flag("separates_on_one_side", state_.separated);
  const LeavingRules::State& boundary = leaving_.state();
  circuit.bound("nearest_while_following", boundary.followed_m, "m");
  inside.picture.layers.push_back({"place to come back to",
                                   domain::PictureLayer::Kind::kPoints,
                                   {},
                                   {loop.anchor_odom.position()}});
  inside.say("Since the place that closes the circuit it has turned by " +
             domain::say_degrees(loop.turned_rad) + ".");
  if (state_.separated) {
    inside.say("A circuit on the other side has shown that the obstacle cuts the target off.");
  }
}

void TrackMode::tell(const Situation& situation, domain::Inside& inside) const {
  const core::Vec2 way = situation.target_odom - state_.begun_odom;
  const double off_m = state_.off_line / std::max(core::length(way), 1e-9);
  inside.values.text("wall", say_side(state_.wall));
  inside.values.flag("at_wall", state_.at_wall);
  inside.values.place("tracked_from", state_.begun_odom);
  inside.values.number("off_line_to_target", off_m, "m");
  inside.values.flag("target_was_off", state_.target_was_off);
  if (!state_.at_wall) {
    inside.say("It is in T mode and turns to the obstacle on the " +
               std::string(say_side(state_.wall)) + ", which it is not beside yet.");
  } else if (parameters_.leave == TrackLeaving::kCollinear) {
    inside.say("It is in T mode and tracks the obstacle on the " +
               std::string(say_side(state_.wall)) +
               " until it crosses the line from where that began to the target, which is " +
               domain::say_metres(std::fabs(off_m)) + " away.");
  } else {
    inside.say("It is in T mode and tracks the obstacle on the " +
               std::string(say_side(state_.wall)) +
               " until that ends where the target has come back to its side.");
  }
  scan::SevenCones eyes = eyes_;
  follower_.tell(eyes.see(situation.scan), state_.wall, inside);
}

}  // namespace clew::recover
