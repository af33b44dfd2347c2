// SPDX-License-Identifier: Apache-2.0
/// What a behaviour may know of the run before the first tick.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/resources.hpp"
#include "domain/infrared_curve.hpp"
#include "domain/messages.hpp"

namespace clew::domain {

/// The robot's body, a disc: configs/robots.
struct Robot {
  std::string name;
  double radius_m = 0.15;
};

/// A range sensor's arrangement, so that what does not fit is refused before the run. The fields
/// are those of Scan.
struct ScanLayout {
  std::string sensor;  ///< the behaviour's name, for messages
  std::size_t beam_count = 0;
  double bearing_first_rad = 0.0;
  double bearing_step_rad = 0.0;
  double beam_width_rad = 0.0;
  double range_max_m = 0.0;
  std::optional<InfraredCurve> infrared_curve = std::nullopt;  ///< of a sensor that answers by one

  /// Bearings of the outermost beams' axes; of at least one beam.
  double leftmost_rad() const { return std::max(bearing_first_rad, bearing_last_rad()); }
  double rightmost_rad() const { return std::min(bearing_first_rad, bearing_last_rad()); }
  /// What two neighbours leave unseen between them; 0 where they overlap.
  double between_beams_rad() const {
    return std::max(0.0, std::fabs(bearing_step_rad) - beam_width_rad);
  }
  /// The field of view: as many steps as beams.
  double field_rad() const { return static_cast<double>(beam_count) * std::fabs(bearing_step_rad); }

 private:
  double bearing_last_rad() const {
    return bearing_first_rad + static_cast<double>(beam_count - 1) * bearing_step_rad;
  }
};

/// What a drive can do, so that nobody asks for more; infinite where it has no limit.
struct MotionLimits {
  double speed_mps = std::numeric_limits<double>::infinity();
  double turn_rate_radps = std::numeric_limits<double>::infinity();
  double acceleration_mps2 = std::numeric_limits<double>::infinity();
  double turn_acceleration_radps2 = std::numeric_limits<double>::infinity();
};

/// In one world.
inline constexpr std::uint32_t kMostRobots = 64;

struct BehaviourSetup {
  double tick_s = 0.3;
  Robot robot;
  ScanLayout scan;  ///< empty for the sensor itself
  MotionLimits limits;
  core::Resources resources;
  /// Which robot of its world it is, from 0. Robot 0 has the way. All others give it, whomever they
  /// meet, and of these the lowest comes back first. A robot that is alone is 0.
  std::uint32_t robot_index = 0;
};

}  // namespace clew::domain
