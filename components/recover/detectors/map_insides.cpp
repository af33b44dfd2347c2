// SPDX-License-Identifier: Apache-2.0
/// What the detectors that look for ways tell.
#include <algorithm>
#include <cmath>

#include "domain/words.hpp"
#include "recover/detectors/map_detour.hpp"
#include "recover/detectors/no_connecting_path.hpp"
#include "recover/detectors/no_safe_region.hpp"
#include "recover/detectors/surrounded.hpp"

namespace clew::recover {

void NoSafeRegion::tell(const Situation& situation, domain::Inside& inside) const {
  const double target_rad = core::bearing_rad(situation.pose(), situation.pursued_odom);
  const double needed_m = std::min(parameters_.depth_ratio * situation.scan.range_max_m,
                                   core::distance_m(situation.pose(), situation.pursued_odom));
  double deepest_m = 0.0;
  std::vector<double> free_m;
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    free_m.push_back(regions_.free_m(i));
    const double off_rad = core::wrap_angle_rad(regions_.bearing_rad(i) - target_rad);
    if (std::fabs(off_rad) <= parameters_.sector_rad) {
      deepest_m = std::max(deepest_m, regions_.free_m(i));
    }
  }
  inside.values.list("free_by_direction", std::move(free_m), "m");
  inside.values.number("deepest_toward_target", deepest_m, "m");
  inside.values.number("needed", needed_m, "m");
  inside.values.number("surrounded_for", static_cast<double>(state_.in_a_row), "ticks");
  inside.values.number("alarm_after", static_cast<double>(parameters_.ticks), "ticks");
  inside.values.number("alarm_share", std::min(1.0, static_cast<double>(state_.in_a_row) /
                                                        static_cast<double>(parameters_.ticks)));
  inside.say("Toward the target the deepest gap is free for " + domain::say_metres(deepest_m) +
             " of the " + domain::say_metres(needed_m) +
             " that are asked for; without such a gap " + "for " +
             domain::say_count(static_cast<std::size_t>(parameters_.ticks), "tick") +
             " it is a trap.");
}

void NoConnectingPath::tell(const Situation& situation, domain::Inside& inside) const {
  const double end_m = parameters_.leg_travel_ratio * state_.leg_m;
  const double share =
      state_.on_leg && end_m > 0.0 ? std::min(1.0, state_.travelled_m / end_m) : 0.0;
  inside.values.flag("on_leg", state_.on_leg);
  inside.values.flag("told", state_.told);
  inside.values.number("alarm_share", state_.told ? 1.0 : share);
  if (!state_.on_leg) {
    inside.say("The way to the target is clear as far as is seen.");
    return;
  }
  inside.values.place("leg_end", state_.leg_end_odom);
  inside.values.number("leg_length", state_.leg_m, "m");
  inside.values.number("travelled_on_leg", state_.travelled_m, "m");
  inside.picture.layers.push_back({"leg that is watched",
                                   domain::PictureLayer::Kind::kWay,
                                   {},
                                   {situation.pose().position(), state_.leg_end_odom}});
  inside.say("The robot is on a leg of " + domain::say_metres(state_.leg_m) + ", " +
             domain::say_metres(core::distance_m(situation.pose(), state_.leg_end_odom)) +
             " from its end, where paths to the target are looked for.");
}

void Surrounded::tell(const Situation&, domain::Inside& inside) const {
  const double share =
      static_cast<double>(state_.in_a_row) / static_cast<double>(parameters_.ticks);
  inside.values.flag("told", state_.told);
  inside.values.number("surrounded_for", static_cast<double>(state_.in_a_row), "ticks");
  inside.values.number("alarm_after", static_cast<double>(parameters_.ticks), "ticks");
  inside.values.number("travelled_toward_target", state_.travelled_m, "m");
  inside.values.number("alarm_share", state_.told ? 1.0 : std::min(1.0, share));
  inside.say(state_.in_a_row == 0
                 ? "A path within what was seen around leads on to the target."
                 : "No path within what was seen around connects to the target, for " +
                       domain::say_count(static_cast<std::size_t>(state_.in_a_row), "tick") + ".");
}

void MapDetour::tell(const Situation& situation, domain::Inside& inside) const {
  const double still_s = static_cast<double>(situation.tick - state_.progress_tick) * tick_s_;
  inside.values.bound("nearest_to_target", state_.least_m, "m");
  inside.values.number("without_progress", still_s, "s");
  inside.values.number("patience", parameters_.patience_s, "s");
  inside.values.flag("path_exists", path_.exists());
  inside.values.number("rise_that_is_a_trap", parameters_.rise_m, "m");
  double share = still_s / parameters_.patience_s;
  std::string what = "No path is known.";
  if (path_.exists()) {
    const core::Vec2 place = situation.pose().position();
    const double rise_m = path_.rise_m(place, situation.target_odom);
    share = std::max(share, parameters_.rise_m > 0.0 ? rise_m / parameters_.rise_m : 0.0);
    inside.values.number("path_length", path_.length_m(place), "m");
    inside.values.number("path_rise", rise_m, "m");
    inside.picture.layers.push_back(
        {"path that is watched", domain::PictureLayer::Kind::kWay, {}, path_.corners_odom()});
    what = "The known path is " + domain::say_metres(path_.length_m(place)) +
           " long and leads away from the target by " + domain::say_metres(rise_m) +
           "; more than " + domain::say_metres(parameters_.rise_m) + " are a trap.";
  }
  inside.values.number("alarm_share", std::clamp(share, 0.0, 1.0));
  inside.say(what + " The robot came nearer to the target " + domain::say_seconds(still_s) +
             " ago.");
}

}  // namespace clew::recover
