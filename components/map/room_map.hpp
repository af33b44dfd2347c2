// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "map/grid.hpp"

namespace clew::map {

/// How much room there is around the middle of each cell, as far as some reach.
struct RoomMap {
  Grid grid;
  std::vector<float> room_m;  ///< by Grid::index; 0 in an obstacle, capped at the reach

  /// Sets one flag a cell: whether a disc of this radius, at most the reach, can stand on its
  /// middle.
  void passable(double radius_m, std::vector<std::uint8_t>& flags) const;
};

/// What is blocked on a grid.
struct BlockedMap {
  Grid grid;
  std::vector<std::uint8_t> blocked;  ///< by Grid::index; not 0 where an obstacle may be
};

/// The distance from each cell's middle to the nearest blocked cell's square, exact, in metres.
/// What lies outside the grid is not known to be free, and so is blocked.
RoomMap room_around(const BlockedMap& map, double reach_m);

}  // namespace clew::map
