// SPDX-License-Identifier: Apache-2.0
#include "recover/detectors/map_detour.hpp"

#include "scan/certain_block.hpp"

namespace clew::recover {

core::Result<std::unique_ptr<MapDetour>> MapDetour::create(const Parameters& parameters,
                                                           const domain::BehaviourSetup& setup) {
  return std::make_unique<MapDetour>(parameters, setup);
}

MapDetour::MapDetour(const Parameters& parameters, const domain::BehaviourSetup& setup)
    : parameters_(parameters),
      tick_s_(setup.tick_s),
      radius_m_(setup.robot.radius_m),
      path_(parameters.path, setup.robot.radius_m, setup.tick_s) {}

std::optional<TrapEvidence> MapDetour::observe(const Situation& situation) {
  TrapEvidence evidence;
  if (!gets_on(situation)) {
    evidence.text = "comes no nearer to the target";
    return evidence;
  }
  // While an escape leads to targets of its own, nobody asks.
  if (situation.pursued_odom != situation.target_odom) return std::nullopt;
  if (comes_in(situation) || !path_.keep_up(situation.path_request())) return std::nullopt;
  if (path_.exists() &&
      path_.rise_m(situation.pose().position(), situation.target_odom) <= parameters_.rise_m)
    return std::nullopt;
  evidence.text = "every way known leads away from the target first";
  return evidence;
}

/// Whether the target is near and in view, and nothing in the way for certain.
bool MapDetour::comes_in(const Situation& situation) const {
  const double distance_m = situation.target_distance_m();
  const double bearing_rad = situation.target_bearing_rad();
  return distance_m <= parameters_.come_in_m && scan::is_in_view(situation.scan, bearing_rad) &&
         !scan::is_certainly_blocked(situation.scan, radius_m_, bearing_rad, distance_m);
}

bool MapDetour::gets_on(const Situation& situation) {
  state_.tick = situation.tick;
  const double distance_m = situation.target_distance_m();
  if (distance_m <= state_.least_m - parameters_.nearer_m) {
    state_.least_m = distance_m;
    state_.progress_tick = situation.tick;
  }
  return static_cast<double>(situation.tick - state_.progress_tick) * tick_s_ <
         parameters_.patience_s;
}

void MapDetour::start_afresh() {
  path_.forget_path();
  state_.least_m = std::numeric_limits<double>::infinity();
  state_.progress_tick = state_.tick;
}

void MapDetour::save(core::StateWriter& writer) const {
  writer(state_);
  path_.save(writer);
}

void MapDetour::load(core::StateReader& reader) {
  reader(state_);
  path_.load(reader);
}

}  // namespace clew::recover
