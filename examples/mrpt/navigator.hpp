// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace clew_mrpt {

struct NavigatorSettings;

/// What a robot knows in a tick, in the frame of its odometry.
struct Input {
  std::array<double, 3> pose{};      ///< x, y in metres, heading in rad
  std::array<double, 2> velocity{};  ///< m/s along the heading, rad/s
  std::array<double, 3> target{};    ///< x, y, radius of arrival, in metres
  std::vector<double> obstacles;     ///< x, y of each point seen, in the robot's frame, in metres
};

/// Speed along the heading and turn rate.
using Velocities = std::array<double, 2>;

/// MRPT's CReactiveNavigationSystem, one step a tick. Its clock is the run's, so the same inputs
/// give the same velocities.
class Navigator {
 public:
  /// Throws std::exception where MRPT refuses the settings.
  Navigator(const NavigatorSettings& settings, double tick_s);
  ~Navigator();
  Navigator(const Navigator&) = delete;
  Navigator& operator=(const Navigator&) = delete;

  Velocities step(const Input& input);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace clew_mrpt
