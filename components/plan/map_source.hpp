// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "map/room_map.hpp"

namespace clew::plan {

/// The map that a planner goes by, in the odometry frame.
class MapSource {
 public:
  virtual ~MapSource() = default;

  /// The room around each cell, as far as `reach_m`.
  virtual map::RoomMap read(double reach_m) const = 0;
};

}  // namespace clew::plan
