// SPDX-License-Identifier: Apache-2.0
#include "recover/detectors/no_progress.hpp"

namespace clew::recover {

core::Result<std::unique_ptr<NoProgress>> NoProgress::create(const Parameters& parameters,
                                                             const domain::BehaviourSetup& setup) {
  return std::make_unique<NoProgress>(parameters, setup.tick_s);
}

std::optional<TrapEvidence> NoProgress::observe(const Situation& situation) {
  const core::Vec2 position = situation.pose().position();
  if (progressed(situation)) {
    state_ = {true, situation.tick, position, situation.odometry.travel_m, situation.pursued_odom};
    return std::nullopt;
  }
  if (static_cast<double>(situation.tick - state_.tick) * tick_s_ <= parameters_.allowance_s) {
    return std::nullopt;
  }
  state_.begun = false;
  return TrapEvidence{EarlierVisit{state_.tick, state_.position_odom,
                                   situation.odometry.travel_m - state_.travel_m, 0},
                      parameters_.of == Progress::kMovement ? "has not got away from here"
                                                            : "has not come nearer to the target"};
}

/// Whether there is progress since there last was, or no telling.
bool NoProgress::progressed(const Situation& situation) const {
  if (!state_.begun) return true;
  if (parameters_.of == Progress::kMovement) {
    return core::distance_m(situation.pose(), state_.position_odom) > parameters_.radius_m;
  }
  if (situation.pursued_odom != state_.pursued_odom) return true;
  const double before_m = core::length(state_.pursued_odom - state_.position_odom);
  return core::distance_m(situation.pose(), situation.pursued_odom) <
         before_m - parameters_.radius_m;
}

void NoProgress::save(core::StateWriter& writer) const { writer(state_); }

void NoProgress::load(core::StateReader& reader) { reader(state_); }

}  // namespace clew::recover
