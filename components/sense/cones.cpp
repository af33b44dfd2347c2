// SPDX-License-Identifier: Apache-2.0
#include "sense/cones.hpp"

#include <algorithm>
#include <optional>

namespace clew::sense {
namespace {

constexpr double kWidthRad = core::radians(15.0);
constexpr double kFirstBearingRad = core::radians(45.0);

// The walls of a right-angled corner, seen along its bisector, come within 0.89 of the corner's
// distance in a cone of 15 degrees. What is nearer than this share of it stands before the corner.
constexpr double kCornerWallsRatio = 0.75;

}  // namespace

core::Result<std::unique_ptr<Cones>> Cones::create(const Parameters& parameters,
                                                   const domain::BehaviourSetup& setup) {
  return std::make_unique<Cones>(parameters, setup.robot.radius_m);
}

Cones::Cones(const Parameters& parameters, double radius_m)
    : parameters_(parameters), radius_m_(radius_m) {}

domain::ScanLayout Cones::layout() const {
  return {"cones", kCount, kFirstBearingRad, -kWidthRad, kWidthRad, parameters_.range_m};
}

void Cones::measure(const world::World& world, const core::Pose2& pose_world_robot,
                    double sim_time_s, const core::Random& random, domain::Scan& scan) const {
  scan.bearing_first_rad = kFirstBearingRad;
  scan.bearing_step_rad = -kWidthRad;
  scan.beam_width_rad = kWidthRad;
  scan.range_min_m = 0.0;
  scan.range_max_m = parameters_.range_m;
  scan.ranges_m.resize(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    const double bearing_rad =
        core::wrap_angle_rad(pose_world_robot.heading_rad + scan.bearing_rad(i));
    double reading_m = echo_m(world, pose_world_robot.position(), bearing_rad, sim_time_s);
    // Each cone has two numbers of its own, drawn or not, so that options do not shift each other.
    const auto index = static_cast<std::uint32_t>(2 * i);
    if (parameters_.noise_stddev_m > 0.0 && reading_m < parameters_.range_m) {
      reading_m += parameters_.noise_stddev_m * random.normal(index);
    }
    if (parameters_.drop_out_ratio > 0.0 &&
        random.uniform(index + 1) < parameters_.drop_out_ratio) {
      reading_m = parameters_.range_m;
    }
    scan.ranges_m[i] = std::clamp(reading_m, 0.0, parameters_.range_m);
  }
}

/// What comes back from one cone without noise, from the skin, at most range_m.
double Cones::echo_m(const world::World& world, const core::Vec2& apex, double bearing_world_rad,
                     double sim_time_s) const {
  const double reach_m = parameters_.range_m + radius_m_;
  double distance_m =
      world.cone_distance_m(apex, bearing_world_rad, 0.5 * kWidthRad, reach_m, sim_time_s);
  if (parameters_.corner_echo_ratio > 0.0) {
    const std::optional<double> corner_m =
        world.corner_distance_m(apex, bearing_world_rad, 0.5 * kWidthRad, reach_m);
    if (corner_m && distance_m >= kCornerWallsRatio * *corner_m) {
      distance_m = *corner_m * (1.0 + parameters_.corner_echo_ratio);
    }
  }
  return std::min(distance_m - radius_m_, parameters_.range_m);
}

}  // namespace clew::sense
