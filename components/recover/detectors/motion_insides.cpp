// SPDX-License-Identifier: Apache-2.0
/// What the detectors that watch how the robot moves tell.
#include <algorithm>
#include <cmath>

#include "domain/words.hpp"
#include "recover/detectors/heading_reversal.hpp"
#include "recover/detectors/no_progress.hpp"
#include "recover/detectors/none.hpp"
#include "recover/detectors/oscillation.hpp"

namespace clew::recover {
namespace {

/// The greatest turn between an instant of the window and the last tick.
double greatest_turn_rad(const HeadingWindow& window) {
  double greatest_rad = 0.0;
  for (const HeadingWindow::Instant& instant : window.state().instants) {
    const double turn_rad = window.state().instants.back().turned_rad - instant.turned_rad;
    greatest_rad = std::max(greatest_rad, std::fabs(turn_rad));
  }
  return greatest_rad;
}

}  // namespace

void HeadingReversal::tell(const Situation&, domain::Inside& inside) const {
  const double turned_rad = greatest_turn_rad(window_);
  inside.values.number("greatest_turn", turned_rad, "rad");
  inside.values.number("turn_that_is_a_trap", parameters_.reversal_rad, "rad");
  inside.values.number("window", static_cast<double>(parameters_.window_ticks), "ticks");
  inside.values.number("alarm_share", std::min(1.0, turned_rad / parameters_.reversal_rad));
  inside.say("In the last " +
             domain::say_count(static_cast<std::size_t>(parameters_.window_ticks), "tick") +
             " the robot turned by " + domain::say_degrees(turned_rad) + "; more than " +
             domain::say_degrees(parameters_.reversal_rad) + " are a trap.");
}

void NoProgress::tell(const Situation& situation, domain::Inside& inside) const {
  const double elapsed_s =
      state_.begun ? static_cast<double>(situation.tick - state_.tick) * tick_s_ : 0.0;
  inside.values.flag("watches", state_.begun);
  inside.values.number("without_progress", elapsed_s, "s");
  inside.values.number("allowance", parameters_.allowance_s, "s");
  inside.values.number("moved_since", core::distance_m(situation.pose(), state_.position_odom),
                       "m");
  inside.values.number("needed", parameters_.radius_m, "m");
  inside.values.number("alarm_share", std::min(1.0, elapsed_s / parameters_.allowance_s));
  inside.say("It waits for progress since " + domain::say_seconds(elapsed_s) + "; after " +
             domain::say_seconds(parameters_.allowance_s) + " that is a trap.");
}

void Oscillation::tell(const Situation&, domain::Inside& inside) const {
  const double turned_rad = greatest_turn_rad(window_);
  domain::PictureLayer places{"turns back", domain::PictureLayer::Kind::kPoints, {}, {}};
  for (const Turn& turn : state_.turns) {
    domain::InsideGroup& item = inside.values.item("turns_back");
    item.number("tick", static_cast<double>(turn.tick));
    item.place("place", turn.pose_odom.position());
    places.places_odom.push_back(turn.pose_odom.position());
  }
  inside.picture.layers.push_back(std::move(places));
  inside.values.number("greatest_turn", turned_rad, "rad");
  inside.values.number("turn_back_from", parameters_.turn_back_rad, "rad");
  inside.values.number("repeated_in_a_row", static_cast<double>(state_.in_a_row));
  inside.values.number("needed_in_a_row", static_cast<double>(parameters_.repeats));
  inside.values.number("alarm_share", static_cast<double>(state_.in_a_row) /
                                          static_cast<double>(parameters_.repeats));
  inside.say("It remembers " + domain::say_count(state_.turns.size(), "turn") + " back; " +
             std::to_string(state_.in_a_row) + " of the " + std::to_string(parameters_.repeats) +
             " in a row that make a trap repeated an earlier one.");
}

void NoDetector::tell(const Situation&, domain::Inside& inside) const {
  inside.values.number("alarm_share", 0.0);
  inside.say("It never says trap.");
}

}  // namespace clew::recover
