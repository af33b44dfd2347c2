// SPDX-License-Identifier: Apache-2.0
#include "recover/detectors/surrounded.hpp"

#include <algorithm>
#include <cmath>

#include "domain/held.hpp"
#include "map/local_map.hpp"
#include "scan/scan_needs.hpp"

namespace clew::recover {
namespace {

// A target farther than this from the one before is another one.
constexpr double kSameTarget_m = 1e-6;
constexpr double kStill_m = 0.1;
// The work of a tick grows with the square of the reach.
constexpr double kMostReach_m = 10.0;
// More than any run has: a state that counts more is a stranger's.
constexpr std::int64_t kMostTicks = 1'000'000'000'000'000;

bool is_another(const core::Vec2& target_odom, const core::Vec2& before_odom) {
  return core::length(target_odom - before_odom) > kSameTarget_m;
}

bool is_virtual(const Situation& situation) {
  return situation.pursued_odom != situation.target_odom;
}

}  // namespace

Surrounded::Surrounded(const Parameters& parameters, const domain::BehaviourSetup& setup)
    : parameters_(parameters),
      still_ticks_(
          static_cast<std::int64_t>(domain::held_ticks(parameters.still_s, kStill_m, setup))),
      ways_(setup.robot.radius_m + parameters.clearance_m) {}

core::Result<std::unique_ptr<Surrounded>> Surrounded::create(const Parameters& parameters,
                                                             const domain::BehaviourSetup& setup) {
  scan::ScanNeeds needs;
  needs.least_beams = 2;
  needs.most_unseen_rad = core::radians(15.0);
  needs.least_field_rad = core::radians(90.0);
  CLEW_RETURN_IF_ERROR(scan::check_needs(needs, setup.scan, "surrounded"));
  return std::make_unique<Surrounded>(parameters, setup);
}

std::optional<TrapEvidence> Surrounded::observe(const Situation& situation) {
  follow(situation);
  if (stands_still(situation)) {
    TrapEvidence evidence{std::nullopt, "stands still"};
    evidence.stands_still = true;
    return evidence;
  }
  if (gets_on(situation)) {
    state_.in_a_row = 0;
    state_.told = false;
    return std::nullopt;
  }
  ++state_.in_a_row;
  if (!may_judge(situation)) return std::nullopt;
  state_.told = true;
  state_.travelled_m = 0.0;
  return TrapEvidence{std::nullopt,
                      "surrounded, and no path within what was seen connects to the target"};
}

/// Notes what target is in force, and the travel under it.
void Surrounded::follow(const Situation& situation) {
  const core::Vec2 position_odom = situation.pose().position();
  const bool is_new_mission = state_.afresh && !is_virtual(situation) &&
                              is_another(situation.target_odom, state_.mission_odom);
  if (!state_.has_target || is_another(situation.pursued_odom, state_.target_odom)) {
    state_.told = state_.has_target && !is_new_mission;
    state_.has_target = true;
    state_.target_odom = situation.pursued_odom;
    state_.travelled_m = 0.0;
    state_.in_a_row = 0;
  } else {
    state_.travelled_m += core::length(position_odom - state_.position_odom);
  }
  state_.position_odom = position_odom;
  state_.mission_odom = situation.target_odom;
  state_.afresh = false;
}

void Surrounded::start_afresh() {
  state_.afresh = true;
  state_.in_a_row = 0;
  state_.still = 0;
  state_.stood_odom = state_.position_odom;
}

/// Whether it has stayed near a place for too long; it counts anew from there.
bool Surrounded::stands_still(const Situation& situation) {
  const core::Vec2 position_odom = situation.pose().position();
  ++state_.still;
  if (core::length(position_odom - state_.stood_odom) > kStill_m) {
    state_.stood_odom = position_odom;
    state_.still = 0;
  }
  if (state_.still < still_ticks_) return false;
  state_.still = 0;
  return true;
}

/// Whether a path connects to the target in force, or leads on to a virtual one.
bool Surrounded::gets_on(const Situation& situation) {
  ways_.look(situation.local_map->seen(), situation.pose().position(),
             std::min(kMostReach_m, parameters_.reach_ratio * situation.scan.range_max_m));
  const double within_m = is_virtual(situation) ? 0.0 : situation.target_radius_m;
  if (ways_.connect(situation.pursued_odom, within_m)) return true;
  return is_virtual(situation) &&
         ways_.lead_on(situation.pose().heading_rad, parameters_.ahead_rad);
}

/// Whether a trap is told now that no path connects.
bool Surrounded::may_judge(const Situation& situation) const {
  if (state_.told && state_.travelled_m < parameters_.again_m) return false;
  if (state_.in_a_row < parameters_.ticks) return false;
  if (!is_virtual(situation)) return true;
  const double off_rad = core::bearing_rad(situation.pose(), situation.pursued_odom);
  return state_.travelled_m >= parameters_.leg_m && std::fabs(off_rad) <= parameters_.facing_rad;
}

void Surrounded::save(core::StateWriter& writer) const { writer(state_); }

void Surrounded::load(core::StateReader& reader) {
  reader(state_);
  const auto is_count = [](std::int64_t ticks) { return ticks >= 0 && ticks < kMostTicks; };
  if (!reader.check(is_count(state_.in_a_row) && is_count(state_.still),
                    "a number of ticks is none")) {
    state_ = {};
  }
}

}  // namespace clew::recover
