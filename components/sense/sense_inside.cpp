// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "domain/words.hpp"
#include "scan/nearest_return.hpp"
#include "sense/sense_component.hpp"

namespace clew::sense {

void SenseComponent::tell(const runtime::TickInputs& samples, domain::Inside& inside) const {
  const auto& state = samples.get<domain::State>();
  const auto& scan = samples.get<domain::Scan>();
  const auto empty = static_cast<std::size_t>(std::count_if(
      scan.ranges_m.begin(), scan.ranges_m.end(), [&](double r) { return r >= scan.range_max_m; }));
  const scan::Return nearest = scan::nearest_return(scan);
  const bool sees = nearest.range_m < scan.range_max_m;
  inside.say("The sensor has " + domain::say_count(scan.ranges_m.size(), "beam") + " and sees " +
             domain::say_metres(scan.range_max_m) + " far.");
  inside.say(
      sees ? "The nearest obstacle is " + domain::say_metres(nearest.range_m) +
                 " from the robot's skin, " + domain::say_bearing(nearest.bearing_rad) +
                 (empty == 0 ? "." : "; " + domain::say_count(empty, "beam") + " saw nothing.")
           : "No beam saw anything.");
  inside.values.number("range_max", scan.range_max_m, "m");
  inside.values.number("nearest", nearest.range_m, "m");
  inside.values.number("nearest_bearing", core::wrap_angle_rad(nearest.bearing_rad), "rad");
  inside.values.number("empty_beams", static_cast<double>(empty));
  std::vector<double> bearings_rad;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    bearings_rad.push_back(core::wrap_angle_rad(scan.bearing_rad(i)));
  }
  inside.values.list("bearings", std::move(bearings_rad), "rad");
  inside.values.list("readings", scan.ranges_m, "m");
  const core::Random random = random_of(samples.tick());
  domain::Inside part;
  sensor_->tell({*world_, state.pose_world_robot, state.stamp.sim_time_s, random, scan}, part);
  inside.add("sensor", std::move(part));
}

}  // namespace clew::sense
