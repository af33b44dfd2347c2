// SPDX-License-Identifier: Apache-2.0
#include "sense/laser.hpp"

#include <algorithm>

namespace clew::sense {

core::Result<std::unique_ptr<Laser>> Laser::create(const Parameters& parameters,
                                                   const domain::BehaviourSetup& setup) {
  return std::make_unique<Laser>(parameters, setup.robot.radius_m);
}

Laser::Laser(const Parameters& parameters, double radius_m)
    : parameters_(parameters),
      radius_m_(radius_m),
      fan_(0.5 * parameters.field_rad,
           -parameters.field_rad / static_cast<double>(parameters.beams - 1),
           static_cast<std::size_t>(parameters.beams)) {}

domain::ScanLayout Laser::layout() const {
  return {"laser", fan_.size(),        fan_.bearing_first_rad(), fan_.bearing_step_rad(),
          0.0,     parameters_.range_m};
}

void Laser::measure(const world::World& world, const core::Pose2& pose_world_robot,
                    double sim_time_s, const core::Random& random, domain::Scan& scan) const {
  scan.bearing_first_rad = fan_.bearing_first_rad();
  scan.bearing_step_rad = fan_.bearing_step_rad();
  scan.beam_width_rad = 0.0;
  scan.range_min_m = 0.0;
  scan.range_max_m = parameters_.range_m;
  world.fan_distances_m(pose_world_robot, fan_, parameters_.range_m + radius_m_, sim_time_s,
                        scan.ranges_m);
  for (double& range_m : scan.ranges_m) {
    range_m = std::clamp(range_m - radius_m_, 0.0, parameters_.range_m);
  }
  add_range_noise(parameters_.noise, random, scan);
}

}  // namespace clew::sense
