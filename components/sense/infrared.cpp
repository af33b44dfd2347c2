// SPDX-License-Identifier: Apache-2.0
#include "sense/infrared.hpp"

#include <algorithm>

#include "core/angle.hpp"

namespace clew::sense {
namespace {

constexpr double kLeft_rad = core::radians(90.0);
constexpr double kQuarter_rad = core::radians(-90.0);

}  // namespace

core::Result<std::unique_ptr<Infrared>> Infrared::create(const Parameters& parameters,
                                                         const domain::BehaviourSetup& setup) {
  return std::make_unique<Infrared>(parameters, setup.robot.radius_m);
}

Infrared::Infrared(const Parameters& parameters, double radius_m)
    : parameters_(parameters), radius_m_(radius_m), fan_(kLeft_rad, kQuarter_rad, kCount) {}

domain::ScanLayout Infrared::layout() const {
  return {"infrared", kCount, kLeft_rad, kQuarter_rad, 0.0, parameters_.range_m, parameters_.curve};
}

void Infrared::measure(const world::World& world, const core::Pose2& pose_world_robot,
                       double sim_time_s, const core::Random& random, domain::Scan& scan) const {
  scan.bearing_first_rad = kLeft_rad;
  scan.bearing_step_rad = kQuarter_rad;
  scan.beam_width_rad = 0.0;
  scan.range_min_m = parameters_.range_min_m;
  scan.range_max_m = parameters_.range_m;
  world.fan_distances_m(pose_world_robot, fan_, parameters_.range_m + radius_m_, sim_time_s,
                        scan.ranges_m);
  for (double& range_m : scan.ranges_m) {
    range_m = std::clamp(range_m - radius_m_, scan.range_min_m, scan.range_max_m);
  }
  add_range_noise(parameters_.noise, random, scan);
  for (double& range_m : scan.ranges_m) {
    if (range_m < scan.range_max_m) range_m = distance_m(parameters_.curve.reading(range_m));
  }
}

double Infrared::distance_m(double reading) const {
  const domain::InfraredCurve& curve = parameters_.curve;
  const double above_offset = (domain::InfraredCurve::kLargestByte - reading) - curve.offset;
  if (above_offset <= 0.0) return parameters_.range_m;
  return std::clamp(curve.gain_m / above_offset, parameters_.range_min_m, parameters_.range_m);
}

}  // namespace clew::sense
