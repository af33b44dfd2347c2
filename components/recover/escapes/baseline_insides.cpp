// SPDX-License-Identifier: Apache-2.0
#include "domain/words.hpp"
#include "recover/escapes/fixed_sequence.hpp"
#include "recover/escapes/none.hpp"

namespace clew::recover {

void FixedSequence::tell(const Situation& situation, domain::Inside& inside) const {
  static constexpr const char* kActions[] = {"clear", "spin", "wait", "back up"};
  const char* action = kActions[static_cast<std::size_t>(state_.action)];
  const double elapsed_s = static_cast<double>(situation.tick - state_.begin_tick) * tick_s_;
  inside.values.text("action", action);
  inside.values.number("action_number", static_cast<double>(state_.taken));
  inside.values.number("actions_at_most", static_cast<double>(parameters_.retries));
  inside.values.number("elapsed", elapsed_s, "s");
  inside.values.number("turn_left", state_.turn_left_rad, "rad");
  inside.values.number("travelled", situation.odometry.travel_m - state_.begin_travel_m, "m");
  inside.say("Action " + std::to_string(state_.taken) + " of " +
             std::to_string(parameters_.retries) + ", " + action + ", began " +
             domain::say_seconds(elapsed_s) + " ago.");
}

void NoEscape::tell(const Situation&, domain::Inside& inside) const {
  inside.values.text("action", "none");
  inside.say("It ends as soon as it begins.");
}

}  // namespace clew::recover
