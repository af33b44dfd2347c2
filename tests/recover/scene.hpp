// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <optional>

#include "core/angle.hpp"
#include "recover/situation.hpp"

namespace clew::recover {

/// What a robot sees at one tick, for tests: seven cones with a range of 1 m, so that readings are
/// shares of it.
class Scene {
 public:
  Scene() {
    scan_.bearing_first_rad = core::radians(45.0);
    scan_.bearing_step_rad = core::radians(-15.0);
    scan_.beam_width_rad = core::radians(15.0);
    scan_.range_max_m = 1.0;
    scan_.ranges_m.assign(7, 1.0);
  }

  Scene& at(double x_m, double y_m, double heading_deg) {
    odometry_.pose_odom_robot = {x_m, y_m, core::radians(heading_deg)};
    return *this;
  }
  Scene& travelled(double travel_m) {
    odometry_.travel_m = travel_m;
    return *this;
  }
  /// Odometry's covariance: variances alone, of x and y each, and of the heading.
  Scene& uncertain(double place_m2, double heading_rad2) {
    odometry_.covariance = {place_m2, 0.0, 0.0, place_m2, 0.0, heading_rad2};
    return *this;
  }
  /// The mission's target, which is pursued.
  Scene& target(double x_m, double y_m) {
    target_ = {x_m, y_m};
    return *this;
  }
  /// Another target in force.
  Scene& pursues(double x_m, double y_m) {
    pursued_ = core::Vec2(x_m, y_m);
    return *this;
  }
  /// Readings, leftmost first.
  Scene& sees(std::initializer_list<double> readings) {
    scan_.ranges_m = readings;
    return *this;
  }
  /// A network's answer to a landmark vector at this tick.
  Scene& recognises(domain::Network network, std::uint32_t neuron,
                    std::array<std::uint8_t, 3> classes, bool created = false) {
    landmark_.presented = true;
    landmark_.classes = classes;
    landmark_.recognitions.clear();
    landmark_.recognitions.push_back(
        {network,
         neuron,
         created,
         {static_cast<double>(classes[0]), static_cast<double>(classes[1]),
          static_cast<double>(classes[2])}});
    return *this;
  }
  Scene& tick(std::uint64_t tick) {
    tick_ = tick;
    return *this;
  }

  Situation situation() const {
    return {tick_, odometry_, scan_, &landmark_, target_, pursued_.value_or(target_), 0.2};
  }
  const domain::Odometry& odometry() const { return odometry_; }
  const domain::Scan& scan() const { return scan_; }
  const domain::Landmark& landmark() const { return landmark_; }
  const core::Vec2& target() const { return target_; }

 private:
  std::uint64_t tick_ = 0;
  domain::Odometry odometry_;
  domain::Scan scan_;
  domain::Landmark landmark_;
  core::Vec2 target_ = core::Vec2(10, 0);
  std::optional<core::Vec2> pursued_;
};

}  // namespace clew::recover
