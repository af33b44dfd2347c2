// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/map_following.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "domain/held.hpp"
#include "map/astar.hpp"
#include "map/neural_path.hpp"

namespace clew::recover {
namespace {

// A corner is passed by the robot itself as closely as this.
constexpr double kAtCorner_m = 0.02;
// A step off what the bumpers feel, so that it does not hold the robot.
constexpr double kOffContact_m = 0.02;
// What holds a robot is this far ahead of its centre.
constexpr double kAhead_m = 0.05;

}  // namespace

MapFollowing::MapFollowing(const Parameters& parameters, const domain::BehaviourSetup& setup,
                           std::unique_ptr<map::PathSearch> search)
    : parameters_(parameters),
      tick_s_(setup.tick_s),
      limits_(setup.limits),
      held_ticks_(domain::held_ticks(parameters.held_s, parameters.held_within_m, setup)),
      path_(parameters.path, setup.robot.radius_m, setup.tick_s, std::move(search)),
      no_room_(setup.robot.radius_m),
      proof_(parameters.proof_s, parameters.path, setup) {}

void MapFollowing::begin(const Situation& situation, const TrapEvidence&) {
  path_.forget_path();
  state_.least_length_m = std::numeric_limits<double>::infinity();
  state_.progress_tick = situation.tick;
}

EscapeStatus MapFollowing::step(const Situation& situation, domain::Guidance& guidance) {
  const bool planned = keep_up(situation);
  if (!path_.exists()) {
    if (!proof_.close(situation, no_room_)) return look_afresh(guidance);
    guidance.why = "what was seen closes every way";
    return EscapeStatus::kUnreachable;
  }
  if (proof_.asks_for_last_look(situation)) return look_afresh(guidance);
  const double distance_m = situation.target_distance_m();
  if (distance_m <= state_.ended_at_m - parameters_.nearer_m &&
      path_.rise_m(situation.pose().position(), situation.target_odom) <=
          parameters_.leave_rise_m) {
    state_.ended_at_m = distance_m;
    return EscapeStatus::kEnded;
  }
  const bool led = !gets_on(situation, planned);
  const core::Vec2 corner_odom =
      path_.next_corner(situation.pose(), led ? kAtCorner_m : parameters_.close_m);
  guidance.target_x_m = corner_odom.x();
  guidance.target_y_m = corner_odom.y();
  guidance.target_is_virtual = true;
  guidance.why = "on the way";
  if (led) {
    guidance.has_override = true;
    guidance.override_motion = motion_to(situation, corner_odom);
    note_where_held(situation, corner_odom);
  }
  return EscapeStatus::kActive;
}

map::PathRequest MapFollowing::path_request(const Situation& situation) const {
  map::PathRequest request = situation.path_request();
  request.no_room = &no_room_;
  return request;
}

/// Seeks a path where that is due. That what held the robot closes every way proves nothing: then
/// all of that is open again.
bool MapFollowing::keep_up(const Situation& situation) {
  if (state_.looks_closely) look_closely(situation);
  const bool planned = path_.keep_up(path_request(situation));
  if (path_.exists() || path_.refused_odom().empty()) return planned;
  state_.looks_closely = true;
  look_closely(situation);
  path_.open_refused();
  path_.plan(path_request(situation));
  return true;
}

void MapFollowing::look_closely(const Situation& situation) {
  no_room_.see(situation.odometry, situation.scan, situation.local_map->path_cell_m());
}

/// Forgets all that was seen, and turns on the spot to see what is there now.
EscapeStatus MapFollowing::look_afresh(domain::Guidance& guidance) {
  path_.forget_all();
  no_room_.forget();
  guidance.has_override = true;
  guidance.override_motion.kind = domain::CommandKind::kTurnAndStep;
  guidance.override_motion.turn_rad =
      std::min(parameters_.turn_first_rad, limits_.turn_rate_radps * tick_s_);
  guidance.why = "looks again at what closes every way";
  return EscapeStatus::kLooksAgain;
}

/// A robot that is led and stays where it is, is held by what it cannot pass, or by its guard.
void MapFollowing::note_where_held(const Situation& situation, const core::Vec2& corner_odom) {
  const core::Vec2 here = situation.pose().position();
  if (core::length(here - state_.held_odom) > parameters_.held_within_m) {
    state_.held_odom = here;
    state_.held_tick = situation.tick;
  }
  if (situation.tick - state_.held_tick < held_ticks_) return;
  const core::Vec2 ahead = corner_odom - here;
  const double distance_m = core::length(ahead);
  if (distance_m > 0.0) {
    path_.refuse(here + std::min(distance_m, kAhead_m) / distance_m * ahead);
    path_.forget_path();
  }
  state_.held_tick = situation.tick;
}

/// Whether the controller brings the robot on along the way.
bool MapFollowing::gets_on(const Situation& situation, bool planned) {
  const double length_m = path_.length_m(situation.pose().position());
  if (planned || length_m < state_.least_length_m - parameters_.shorter_m) {
    state_.least_length_m = length_m;
    state_.progress_tick = situation.tick;
  }
  const auto still = static_cast<double>(situation.tick - state_.progress_tick);
  return still * tick_s_ < parameters_.patience_s;
}

domain::Motion MapFollowing::motion_to(const Situation& situation,
                                       const core::Vec2& place_odom) const {
  domain::Motion motion;
  if (!situation.odometry.contact_bearings_rad.empty()) {
    core::Vec2 away = core::Vec2::Zero();
    for (const double bearing_rad : situation.odometry.contact_bearings_rad) {
      away -= core::direction(bearing_rad);
    }
    motion.kind = domain::CommandKind::kTurnAndStep;
    motion.turn_rad = core::atan2(away.y(), away.x());
    motion.step_m = kOffContact_m;
    return motion;
  }
  motion.kind = domain::CommandKind::kTurnAndStep;
  motion.turn_rad = core::bearing_rad(situation.pose(), place_odom);
  if (std::fabs(motion.turn_rad) > parameters_.turn_first_rad) return motion;
  // More than a drive can turn in a tick would slow its step down.
  const double most_rad = limits_.turn_rate_radps * tick_s_;
  motion.turn_rad = std::clamp(motion.turn_rad, -most_rad, most_rad);
  motion.step_m =
      std::min(core::distance_m(situation.pose(), place_odom), limits_.speed_mps * tick_s_);
  return motion;
}

void MapFollowing::save(core::StateWriter& writer) const {
  writer(state_);
  path_.save(writer);
  no_room_.save(writer);
  proof_.save(writer);
}

void MapFollowing::load(core::StateReader& reader) {
  reader(state_);
  path_.load(reader);
  no_room_.load(reader);
  proof_.load(reader);
}

core::Result<std::unique_ptr<RememberedMap>> RememberedMap::create(
    const Parameters& parameters, const domain::BehaviourSetup& setup) {
  std::unique_ptr<map::PathSearch> search;  // null: of least cost
  if (parameters.search == PathBy::kNeural) {
    auto landscape = map::NeuralMap::create({});
    if (!landscape.ok()) return landscape.error();
    search = std::make_unique<map::NeuralPath>(std::move(landscape).value());
  }
  return std::make_unique<RememberedMap>(parameters.following, setup, std::move(search));
}

core::Result<std::unique_ptr<RememberedAStar>> RememberedAStar::create(
    const Parameters& parameters, const domain::BehaviourSetup& setup) {
  return std::make_unique<RememberedAStar>(parameters, setup, std::make_unique<map::AStar>());
}

}  // namespace clew::recover
