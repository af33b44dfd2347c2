// SPDX-License-Identifier: Apache-2.0
#include "sense/sonar_ring.hpp"

#include <algorithm>

namespace clew::sense {
namespace {

constexpr double kAstern_rad = core::kPi;

}  // namespace

core::Result<std::unique_ptr<SonarRing>> SonarRing::create(const Parameters& parameters,
                                                           const domain::BehaviourSetup& setup) {
  return std::make_unique<SonarRing>(parameters, setup.robot.radius_m);
}

SonarRing::SonarRing(const Parameters& parameters, double radius_m)
    : parameters_(parameters),
      radius_m_(radius_m),
      cones_(static_cast<std::size_t>(parameters.sonars)) {
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    const double bearing_rad = kAstern_rad + static_cast<double>(i) * bearing_step_rad();
    cones_[i] = world::ConeDirection::of(bearing_rad, 0.5 * parameters.cone_rad);
  }
}

domain::ScanLayout SonarRing::layout() const {
  return {"sonar_ring",       cones_.size(),        kAstern_rad,
          bearing_step_rad(), parameters_.cone_rad, parameters_.range_m};
}

void SonarRing::measure(const world::World& world, const core::Pose2& pose_world_robot,
                        double sim_time_s, const core::Random& random, domain::Scan& scan) const {
  scan.bearing_first_rad = kAstern_rad;
  scan.bearing_step_rad = bearing_step_rad();
  scan.beam_width_rad = parameters_.cone_rad;
  scan.range_min_m = 0.0;
  scan.range_max_m = parameters_.range_m;
  scan.ranges_m.resize(cones_.size());
  const core::Vec2 apex = pose_world_robot.position();
  const core::Vec2 heading = core::direction(pose_world_robot.heading_rad);
  const double reach_m = parameters_.range_m + radius_m_;
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    const double distance_m =
        world.cone_distance_m(apex, cones_[i].turned(heading), reach_m, sim_time_s);
    scan.ranges_m[i] = std::clamp(distance_m - radius_m_, 0.0, parameters_.range_m);
  }
  add_range_noise(parameters_.noise, random, scan);
}

}  // namespace clew::sense
