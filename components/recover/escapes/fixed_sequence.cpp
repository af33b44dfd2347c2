// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/fixed_sequence.hpp"

#include <algorithm>

namespace clew::recover {

using domain::CommandKind;

void FixedSequence::begin(const Situation& situation, const TrapEvidence&) {
  constexpr int kActions = 4;
  state_.action = static_cast<Action>((static_cast<int>(state_.action) + 1) % kActions);
  ++state_.taken;
  state_.begin_tick = situation.tick;
  state_.begin_travel_m = situation.odometry.travel_m;
  state_.turn_left_rad = state_.action == Action::kSpin ? parameters_.spin_rad : core::kPi;
}

EscapeStatus FixedSequence::step(const Situation& situation, domain::Guidance& guidance) {
  if (state_.taken > parameters_.retries) {
    guidance.why = "no retries left";
    return EscapeStatus::kFailed;
  }
  const double elapsed_s = static_cast<double>(situation.tick - state_.begin_tick) * tick_s_;
  switch (state_.action) {
    case Action::kClear:
      break;
    case Action::kSpin:
      guidance.why = "spin";
      return turn(guidance);
    case Action::kWait:
      guidance.why = "wait";
      return wait(elapsed_s, guidance);
    case Action::kBackUp:
      guidance.why = "back up";
      return back_up(situation, elapsed_s, guidance);
  }
  guidance.why = "clear";
  return EscapeStatus::kEnded;
}

EscapeStatus FixedSequence::turn(domain::Guidance& guidance) {
  if (state_.turn_left_rad <= 0.0) return EscapeStatus::kEnded;
  const double turn_rad = std::min(state_.turn_left_rad, parameters_.spin_rate_radps * tick_s_);
  state_.turn_left_rad -= turn_rad;
  guidance.has_override = true;
  guidance.override_motion.kind = CommandKind::kTurnAndStep;
  guidance.override_motion.turn_rad = turn_rad;
  return EscapeStatus::kActive;
}

EscapeStatus FixedSequence::wait(double elapsed_s, domain::Guidance& guidance) {
  if (elapsed_s >= parameters_.wait_s) return EscapeStatus::kEnded;
  guidance.has_override = true;
  guidance.override_motion.kind = CommandKind::kStop;
  return EscapeStatus::kActive;
}

EscapeStatus FixedSequence::back_up(const Situation& situation, double elapsed_s,
                                    domain::Guidance& guidance) {
  if (turn(guidance) == EscapeStatus::kActive) return EscapeStatus::kActive;
  const double left_m =
      parameters_.back_up_m - (situation.odometry.travel_m - state_.begin_travel_m);
  if (left_m <= 0.0 || elapsed_s >= parameters_.allowance_s) return EscapeStatus::kEnded;
  guidance.has_override = true;
  guidance.override_motion.kind = CommandKind::kTurnAndStep;
  guidance.override_motion.step_m = std::min(left_m, parameters_.back_up_mps * tick_s_);
  return EscapeStatus::kActive;
}

void FixedSequence::save(core::StateWriter& writer) const { writer(state_); }

void FixedSequence::load(core::StateReader& reader) {
  reader(state_);
  if (!reader.check(state_.action <= Action::kBackUp, "there is no such action")) state_ = {};
}

}  // namespace clew::recover
