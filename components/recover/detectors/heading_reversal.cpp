// SPDX-License-Identifier: Apache-2.0
#include "recover/detectors/heading_reversal.hpp"

#include <cmath>
#include <string>

namespace clew::recover {

std::optional<TrapEvidence> HeadingReversal::observe(const Situation& situation) {
  const auto turn = window_.add(situation, parameters_.reversal_rad);
  if (!turn) return std::nullopt;
  window_.clear();
  return TrapEvidence{EarlierVisit{turn->since.tick, turn->since.position_odom,
                                   situation.odometry.travel_m - turn->since.travel_m, 0},
                      "turned " + std::to_string(std::lround(core::degrees(turn->turned_rad))) +
                          " deg in " + std::to_string(situation.tick - turn->since.tick) +
                          " ticks"};
}

void HeadingReversal::save(core::StateWriter& writer) const { writer(window_.state()); }

void HeadingReversal::load(core::StateReader& reader) { reader(window_.state()); }

}  // namespace clew::recover
