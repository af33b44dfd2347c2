// SPDX-License-Identifier: Apache-2.0
#include "map/room_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace clew::map {
namespace {

// A disc that touches has room: distances are rounded to floats.
constexpr float kRounding_m = 1e-6F;

// How many cells lie between each cell of a row and the nearest blocked one, capped; 0 next to it,
// -1 on it.
void gaps_of_row(const std::uint8_t* blocked, std::int32_t columns, std::int32_t cap,
                 std::int32_t* gaps) {
  std::int32_t gap = cap;
  for (std::int32_t i = 0; i < columns; ++i) {
    gap = blocked[i] != 0 ? -1 : std::min(gap + 1, cap);
    gaps[i] = gap;
  }
  gap = cap;
  for (std::int32_t i = columns; i-- > 0;) {
    gap = blocked[i] != 0 ? -1 : std::min(gap + 1, cap);
    gaps[i] = std::min(gaps[i], gap);
  }
}

// From a middle to the near side of a square so many cells on, in cells.
double to_side(std::int32_t gap) { return gap < 0 ? 0.0 : gap + 0.5; }

}  // namespace

void RoomMap::passable(double radius_m, std::vector<std::uint8_t>& flags) const {
  flags.resize(room_m.size());
  const float least_m = static_cast<float>(radius_m) - kRounding_m;
  for (std::size_t i = 0; i < room_m.size(); ++i) flags[i] = room_m[i] >= least_m ? 1 : 0;
}

RoomMap room_around(const BlockedMap& blocked, double reach_m) {
  const Grid& grid = blocked.grid;
  // Beyond so many cells, nothing is within reach.
  const auto cap = static_cast<std::int32_t>(std::ceil(reach_m / grid.cell_m)) + 1;
  std::vector<std::int32_t> gaps(grid.size());
  for (std::int32_t row = 0; row < grid.rows; ++row) {
    const std::size_t first = grid.index({0, row});
    gaps_of_row(blocked.blocked.data() + first, grid.columns, cap, gaps.data() + first);
  }
  RoomMap map{grid, std::vector<float>(grid.size())};
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Cell cell = grid.cell(i);
    const std::int32_t last = std::min(cell.row + cap, grid.rows - 1);
    double nearest_m = std::min(
        reach_m,
        grid.cell_m * to_side(std::min(std::min(cell.column, grid.columns - 1 - cell.column),
                                       std::min(cell.row, grid.rows - 1 - cell.row))));
    for (std::int32_t row = std::max(cell.row - cap, 0); row <= last; ++row) {
      const std::int32_t gap = gaps[grid.index({cell.column, row})];
      if (gap >= cap) continue;
      const double up = to_side(std::abs(row - cell.row) - 1);
      nearest_m = std::min(nearest_m, grid.cell_m * core::hypot(to_side(gap), up));
    }
    map.room_m[i] = static_cast<float>(nearest_m);
  }
  return map;
}

}  // namespace clew::map
