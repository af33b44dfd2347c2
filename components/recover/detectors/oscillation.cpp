// SPDX-License-Identifier: Apache-2.0
#include "recover/detectors/oscillation.hpp"

#include <cmath>

namespace clew::recover {

std::optional<TrapEvidence> Oscillation::observe(const Situation& situation) {
  if (!window_.add(situation, parameters_.turn_back_rad)) return std::nullopt;
  window_.clear();
  const Turn now{situation.tick, situation.pose(), situation.odometry.travel_m};
  const Turn* before = nullptr;
  for (const Turn& turn : state_.turns) {
    if (same(now, turn)) before = &turn;
  }
  state_.in_a_row = before == nullptr ? 0 : state_.in_a_row + 1;
  if (state_.in_a_row >= parameters_.repeats) {
    TrapEvidence evidence{EarlierVisit{before->tick, before->pose_odom.position(),
                                       now.travel_m - before->travel_m, 0},
                          "turned back here before"};
    start_afresh();
    return evidence;
  }
  if (state_.turns.full()) {
    for (std::size_t i = 1; i < kTurns; ++i) state_.turns[i - 1] = state_.turns[i];
    state_.turns.resize(kTurns - 1);
  }
  state_.turns.push_back(now);
  return std::nullopt;
}

/// Whether the later turn back repeats the earlier one.
bool Oscillation::same(const Turn& later, const Turn& earlier) const {
  const double apart_m = core::distance_m(later.pose_odom, earlier.pose_odom.position());
  const double turned_rad =
      std::fabs(core::wrap_angle_rad(later.pose_odom.heading_rad - earlier.pose_odom.heading_rad));
  return apart_m <= parameters_.same_place_m && turned_rad <= parameters_.same_direction_rad &&
         later.travel_m - earlier.travel_m <= parameters_.window_m;
}

void Oscillation::start_afresh() {
  window_.clear();
  state_ = {};
}

void Oscillation::save(core::StateWriter& writer) const { writer(state_, window_.state()); }

void Oscillation::load(core::StateReader& reader) {
  reader(state_, window_.state());
  // More than the parameter allows are a stranger's.
  constexpr std::int64_t kMostRepeats = 1000;
  const bool counts = state_.in_a_row >= 0 && state_.in_a_row < kMostRepeats;
  if (!reader.check(counts, "a number of repeats is none")) state_ = {};
}

}  // namespace clew::recover
