// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/following/obstacle_following.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "recover/escapes/following/flanks.hpp"
#include "scan/certain_block.hpp"
#include "scan/nearest_return.hpp"

namespace clew::recover {
namespace {

// A bearing beyond this is behind the robot.
constexpr double kBehind_rad = core::radians(90.0);

}  // namespace

core::Result<std::unique_ptr<ObstacleFollowing>> ObstacleFollowing::create(
    const Parameters& parameters, const domain::BehaviourSetup& setup) {
  CLEW_RETURN_IF_ERROR(scan::SevenCones::check(setup.scan, "obstacle_following"));
  const auto resource = setup.resources.find("rulebases", parameters.rules);
  if (!resource.ok()) return resource.error();
  const auto rules = WallRules::parse(*resource);
  if (!rules.ok()) return rules.error();
  return std::make_unique<ObstacleFollowing>(parameters, *rules, setup);
}

ObstacleFollowing::ObstacleFollowing(const Parameters& parameters, const WallRules& rules,
                                     const domain::BehaviourSetup& setup)
    : parameters_(parameters),
      radius_m_(setup.robot.radius_m),
      follower_(rules),
      close_follower_(rules.scaled(parameters.close_share)),
      eyes_(parameters.range_m),
      loop_(parameters.same_place_m) {}

void ObstacleFollowing::begin(const Situation& all, const TrapEvidence&) {
  const Situation situation = all.with(eyes_.see(all.scan));
  const double last_leave_m = state_.last_leave_m;
  state_ = {};
  state_.last_leave_m = last_leave_m;
  state_.wall = obstacle_side(situation);
  state_.in_view_travel_m = situation.odometry.travel_m;
  const bool same_side = side_of(situation.target_bearing_rad()) == state_.wall;
  if (same_side || !follower_.sees_obstacle(situation.scan)) {
    enter(Phase::kSeek, situation);  // cases i and ii
  } else {
    const double obstacle_rad = scan::nearest_return(situation.scan).bearing_rad;
    begin_turning(turn_about_rad(obstacle_rad, situation.target_bearing_rad()),
                  situation);  // cases iii and iv
  }
}

/// In step 1 it goes on by following the obstacle; a robot that stands still while it follows one
/// is held by what its eyes do not tell of.
bool ObstacleFollowing::take_up(const Situation& all, const TrapEvidence& evidence) {
  if (!evidence.stands_still) return false;
  const Situation situation = all.with(eyes_.see(all.scan));
  if (state_.phase == Phase::kSeek && follower_.sees_obstacle(situation.scan)) {
    state_.wall = obstacle_side(situation);
    begin_following(situation);
  } else {
    held_ = true;
  }
  return true;
}

EscapeStatus ObstacleFollowing::step(const Situation& all, domain::Guidance& guidance) {
  const Situation situation = all.with(eyes_.see(all.scan));
  if (std::exchange(held_, false)) {
    guidance.why = "stands still";
    return EscapeStatus::kFailed;
  }
  EscapeStatus status = EscapeStatus::kActive;
  if (state_.phase == Phase::kSeek) status = seek(situation);
  if (state_.phase == Phase::kFollow) status = follow(situation, guidance);
  if (state_.phase == Phase::kTurnAbout) turn_about(situation, guidance);
  if (state_.phase == Phase::kSeek) guidance.why = "step 1";
  return status;
}

void ObstacleFollowing::enter(Phase phase, const Situation& situation) {
  state_.phase = phase;
  state_.phase_travel_m = situation.odometry.travel_m;
}

/// Turns about; then the obstacle is on the other side.
void ObstacleFollowing::begin_turning(double turn_rad, const Situation& situation) {
  state_.turn_left_rad = turn_rad;
  state_.wall = opposite(state_.wall);
  enter(Phase::kTurnAbout, situation);
}

void ObstacleFollowing::begin_following(const Situation& situation) {
  enter(Phase::kFollow, situation);
  state_.wall_travel_m = situation.odometry.travel_m;
  loop_.begin(situation.pose(), situation.odometry.travel_m, situation.target_odom);
  if (state_.separated) return;  // the second circuit leaves by the same distance
  state_.followed = true;
  leaving_.hit(situation);
  state_.leave_below_m = std::min(state_.last_leave_m, situation.target_distance_m()) -
                         parameters_.nearer_ratio * situation.scan.range_max_m;
}

/// Step 1: the controller is in charge.
EscapeStatus ObstacleFollowing::seek(const Situation& situation) {
  const double travel_m = situation.odometry.travel_m;
  const bool ends = state_.followed && parameters_.leave != LeavingRule::kPaper;
  if (!follower_.sees_obstacle(situation.scan)) {
    const bool open = travel_m - state_.in_view_travel_m > parameters_.open_m;
    return ends && open ? EscapeStatus::kEnded : EscapeStatus::kActive;
  }
  state_.in_view_travel_m = travel_m;

  const double target_rad = situation.target_bearing_rad();
  const Side obstacle = obstacle_side(situation);
  const double sought_m = travel_m - state_.phase_travel_m;
  if (side_of(target_rad) == obstacle) state_.wall = obstacle;
  const bool swapped = side_of(target_rad) != obstacle && obstacle == state_.wall &&
                       std::fabs(target_rad) > kBehind_rad;
  if (swapped || (!state_.followed && sought_m > parameters_.first_seek_m)) {
    state_.wall = obstacle;
    begin_following(situation);
  } else if (ends && sought_m > parameters_.seek_m) {
    return EscapeStatus::kEnded;
  }
  return EscapeStatus::kActive;
}

void ObstacleFollowing::turn_about(const Situation& situation, domain::Guidance& guidance) {
  const double turn_rad =
      std::clamp(state_.turn_left_rad, -parameters_.turn_step_rad, parameters_.turn_step_rad);
  state_.turn_left_rad -= turn_rad;
  guidance.has_override = true;
  guidance.override_motion.kind = domain::CommandKind::kTurnAndStep;
  guidance.override_motion.turn_rad = turn_rad;
  guidance.why = "turn about";
  if (state_.turn_left_rad == 0.0) begin_following(situation);
}

/// Steps 2 to 4.
EscapeStatus ObstacleFollowing::follow(const Situation& situation, domain::Guidance& guidance) {
  const double travel_m = situation.odometry.travel_m;
  if (!follower().at_break(situation.scan, state_.wall)) state_.wall_travel_m = travel_m;
  if (travel_m - state_.wall_travel_m > parameters_.lost_wall_m) {
    guidance.why = "no wall to follow";
    return EscapeStatus::kFailed;
  }
  const bool clear = way_is_clear(situation);
  if (may_come_in(situation) || may_leave(situation, clear)) {
    state_.separated = false;
    state_.last_leave_m = situation.target_distance_m();
    leaving_.leave();
    state_.in_view_travel_m = travel_m;
    enter(Phase::kSeek, situation);
    return EscapeStatus::kActive;
  }
  const auto result =
      loop_.add(situation.pose(), travel_m, situation.target_odom, clear, state_.wall);
  if (result) {
    const EscapeStatus status = come_round(*result, situation, guidance);
    if (status != EscapeStatus::kActive || state_.phase != Phase::kFollow) return status;
  }
  guidance.has_override = true;
  guidance.override_motion = follower().follow(situation.scan, state_.wall);
  guidance.why = state_.wall == Side::kLeft ? "wall on left" : "wall on right";
  return EscapeStatus::kActive;
}

/// The turn toward the wall that is followed, until it is abeam on the other side.
double ObstacleFollowing::turn_back_rad(const Situation& situation) const {
  const double bearing_rad = scan::nearest_return(situation.scan).bearing_rad;
  return sign(state_.wall) * (0.5 * core::kPi + std::max(0.0, sign(state_.wall) * bearing_rad));
}

/// A circuit has closed.
EscapeStatus ObstacleFollowing::come_round(LoopResult result, const Situation& situation,
                                           domain::Guidance& guidance) {
  if (result == LoopResult::kSeparates) {
    if (state_.separated) {
      guidance.why = "a wall all round, on both sides";
      return EscapeStatus::kFailed;
    }
    state_.separated = true;
    begin_turning(turn_back_rad(situation), situation);
    return EscapeStatus::kActive;
  }
  if (state_.came_round || !std::isfinite(loop_.nearest_clear_m())) {
    guidance.why = "came round without a place to leave";
    return EscapeStatus::kFailed;
  }
  state_.came_round = true;
  state_.leave_below_m = loop_.nearest_clear_m() + parameters_.same_place_m;
  loop_.begin(situation.pose(), situation.odometry.travel_m, situation.target_odom);
  return EscapeStatus::kActive;
}

/// The least reading around the target's direction; 0 if that is not in view.
double ObstacleFollowing::free_toward_target_m(const Situation& situation) const {
  const domain::Scan& scan = situation.scan;
  const double target_rad = situation.target_bearing_rad();
  double free_m = scan.range_max_m;
  bool seen = false;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double off_rad = std::fabs(core::wrap_angle_rad(scan.bearing_rad(i) - target_rad));
    if (off_rad > 1.5 * scan.beam_width_rad) continue;
    if (off_rad <= 0.5 * scan.beam_width_rad) seen = true;
    free_m = std::min(free_m, scan.ranges_m[i]);
  }
  return seen ? free_m : 0.0;
}

/// Whether the way toward the target is clear, as far as that or clear_ratio.
bool ObstacleFollowing::way_is_clear(const Situation& situation) const {
  return free_toward_target_m(situation) >=
         std::min(parameters_.clear_ratio * situation.scan.range_max_m,
                  situation.target_distance_m());
}

bool ObstacleFollowing::may_come_in(const Situation& situation) const {
  const double distance_m = situation.target_distance_m();
  // Ever nearer, as where it leaves by the rule.
  if (distance_m >
      std::min(parameters_.come_in_m, state_.last_leave_m - parameters_.same_place_m)) {
    return false;
  }
  const domain::Scan& scan = situation.scan;
  const double target_rad = situation.target_bearing_rad();
  return scan::is_in_view(scan, target_rad) &&
         !scan::is_certainly_blocked(scan, radius_m_, target_rad, distance_m);
}

bool ObstacleFollowing::may_leave(const Situation& situation, bool clear) const {
  if (parameters_.leave == LeavingRule::kPaper) {
    return follower().at_break(situation.scan, state_.wall) &&
           side_of(situation.target_bearing_rad()) == state_.wall;
  }
  if (parameters_.leave == LeavingRule::kNearer || state_.came_round) {
    return clear && situation.target_distance_m() < state_.leave_below_m;
  }
  return leaving_.may_leave(parameters_.leave, situation, free_toward_target_m(situation), clear,
                            parameters_.nearer_ratio * situation.scan.range_max_m);
}

void ObstacleFollowing::save(core::StateWriter& writer) const {
  writer(state_, loop_.state(), leaving_.state());
}

void ObstacleFollowing::load(core::StateReader& reader) {
  reader(state_, loop_.state(), leaving_.state());
  const auto is_side = [](Side side) { return side == Side::kLeft || side == Side::kRight; };
  const bool valid = state_.phase <= Phase::kFollow && is_side(state_.wall);
  if (!reader.check(valid, "there is no such phase or side")) state_ = {};
}

}  // namespace clew::recover
