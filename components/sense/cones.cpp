// SPDX-License-Identifier: Apache-2.0
#include "sense/cones.hpp"

#include <algorithm>
#include <optional>

namespace clew::sense {
namespace {

constexpr double kWidth_rad = core::radians(15.0);
constexpr double kFirstBearing_rad = core::radians(45.0);

// The walls of a right-angled corner, seen along its bisector, come within 0.89 of the corner's
// distance in a cone of 15 degrees. What is nearer than this share of it stands before the corner.
constexpr double kCornerWallsRatio = 0.75;

}  // namespace

core::Result<std::unique_ptr<Cones>> Cones::create(const Parameters& parameters,
                                                   const domain::BehaviourSetup& setup) {
  return std::make_unique<Cones>(parameters, setup.robot.radius_m);
}

Cones::Cones(const Parameters& parameters, double radius_m)
    : parameters_(parameters), radius_m_(radius_m) {
  for (std::size_t i = 0; i < kCount; ++i) {
    const double bearing_rad = kFirstBearing_rad - static_cast<double>(i) * kWidth_rad;
    cones_[i] = world::ConeDirection::of(bearing_rad, 0.5 * kWidth_rad);
  }
}

domain::ScanLayout Cones::layout() const {
  return {"cones", kCount, kFirstBearing_rad, -kWidth_rad, kWidth_rad, parameters_.range_m};
}

void Cones::measure(const world::World& world, const core::Pose2& pose_world_robot,
                    double sim_time_s, const core::Random& random, domain::Scan& scan) const {
  scan.bearing_first_rad = kFirstBearing_rad;
  scan.bearing_step_rad = -kWidth_rad;
  scan.beam_width_rad = kWidth_rad;
  scan.range_min_m = 0.0;
  scan.range_max_m = parameters_.range_m;
  scan.ranges_m.resize(kCount);
  const core::Vec2 heading = core::direction(pose_world_robot.heading_rad);
  for (std::size_t i = 0; i < kCount; ++i) {
    scan.ranges_m[i] = echo_m(world, pose_world_robot, heading, sim_time_s, i);
  }
  add_range_noise(parameters_.noise, random, scan);
}

/// What comes back from cone i without noise, from the skin, in [0, range_m].
double Cones::echo_m(const world::World& world, const core::Pose2& pose_world_robot,
                     const core::Vec2& heading, double sim_time_s, std::size_t i) const {
  const core::Vec2 apex = pose_world_robot.position();
  const double reach_m = parameters_.range_m + radius_m_;
  double distance_m = world.cone_distance_m(apex, cones_[i].turned(heading), reach_m, sim_time_s);
  if (parameters_.corner_echo_ratio > 0.0) {
    const double bearing_rad = core::wrap_angle_rad(
        pose_world_robot.heading_rad + kFirstBearing_rad - static_cast<double>(i) * kWidth_rad);
    const std::optional<double> corner_m =
        world.corner_distance_m(apex, bearing_rad, 0.5 * kWidth_rad, reach_m);
    if (corner_m && distance_m >= kCornerWallsRatio * *corner_m) {
      distance_m = *corner_m * (1.0 + parameters_.corner_echo_ratio);
    }
  }
  return std::clamp(distance_m - radius_m_, 0.0, parameters_.range_m);
}

}  // namespace clew::sense
