// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "domain/messages.hpp"

namespace clew::recover {

/// A side of the robot.
enum class Side : std::int8_t { kRight = -1, kLeft = 1 };

inline Side opposite(Side side) { return side == Side::kLeft ? Side::kRight : Side::kLeft; }
/// 1 for left, -1 for right: the sign of bearings on that side.
inline double sign(Side side) { return side == Side::kLeft ? 1.0 : -1.0; }
inline Side side_of(double bearing_rad) { return bearing_rad > 0.0 ? Side::kLeft : Side::kRight; }

struct WallRules {
  double side_ratio = 0.32;
  double break_ratio = 0.67;
  double front_ratio = 0.3;
  double blocked_turn_deg = 20.0;
  double gain_deg = 25.0;
  double correct_turn_deg = 12.0;
  double break_turn_deg = 12.0;
  double slow_step_m = 0.05;
  double step_m = 0.1;
  double break_step_m = 0.1;
};

/// Readings as shares of the range, mirrored so that the wall's side comes first.
std::array<double, 7> from_side(const domain::Scan& scan, Side side);

bool at_break(const domain::Scan& scan, Side side, const WallRules& rules);
domain::Motion follow_wall(const domain::Scan& scan, Side side, const WallRules& rules);

}  // namespace clew::recover
