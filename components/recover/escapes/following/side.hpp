// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace clew::recover {

/// A side of the robot.
enum class Side : std::int8_t { kRight = -1, kLeft = 1 };

inline Side opposite(Side side) { return side == Side::kLeft ? Side::kRight : Side::kLeft; }

/// The sign of bearings and turns to that side.
inline double sign(Side side) { return side == Side::kLeft ? 1.0 : -1.0; }

/// The side that a bearing is on; straight ahead is right.
inline Side side_of(double bearing_rad) { return bearing_rad > 0.0 ? Side::kLeft : Side::kRight; }

}  // namespace clew::recover
