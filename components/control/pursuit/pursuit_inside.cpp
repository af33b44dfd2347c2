// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "control/pursuit/regulated_pure_pursuit.hpp"
#include "domain/words.hpp"

namespace clew::control {

void RegulatedPurePursuit::tell(const domain::Odometry& odometry, const domain::Scan& scan,
                                const core::Vec2& target_odom, domain::Inside& inside) const {
  const Pursuit pursuit = pursue(odometry, scan, target_odom);
  inside.values.place("pursued", target_odom);
  inside.values.number("distance", pursuit.distance_m, "m");
  inside.values.number("bearing", pursuit.bearing_rad, "rad");
  inside.values.number("curvature_per_metre", pursuit.curvature_per_m);
  inside.values.number("speed_in_curve", pursuit.in_curve_mps, "mps");
  inside.values.number("speed_beside_obstacle", pursuit.beside_obstacle_mps, "mps");
  inside.values.number("speed_before_place", pursuit.before_place_mps, "mps");
  inside.values.number("speed", pursuit.chosen_mps, "mps");
  const bool turns = std::fabs(pursuit.bearing_rad) > parameters_.turn_first_rad;
  inside.values.flag("turns_on_the_spot", turns);
  inside.say("It pursues a place " + domain::say_metres(pursuit.distance_m) + " away.");
  if (turns) {
    inside.say("That is so far to the side that it turns on the spot.");
  } else {
    inside.say("The arc there allows " + domain::say_number(pursuit.in_curve_mps) +
               " m/s, the obstacles " + domain::say_number(pursuit.beside_obstacle_mps) +
               " m/s; it asks for " + domain::say_number(pursuit.chosen_mps) + " m/s.");
  }
}

}  // namespace clew::control
