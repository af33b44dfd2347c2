// SPDX-License-Identifier: Apache-2.0
#include "map/grid.hpp"

namespace clew::map {
namespace {

/// The number of the corner's column and row in the plane. Grids may lie half a cell beside.
std::int64_t number_of(double coordinate_m, double cell_m) {
  return static_cast<std::int64_t>(std::floor(coordinate_m / cell_m + 0.25));
}

/// Room for a quarter more, so that a grid that grows seldom needs another ring.
std::size_t roomy(std::int32_t cells) {
  return static_cast<std::size_t>(cells) + static_cast<std::size_t>(std::max(64, cells / 4));
}

/// The place of the cell of that number in the plane. Unsigned numbers wrap as the ring does.
std::size_t place_in_ring(const Grid& grid, std::size_t stride, std::size_t last_place) {
  const auto column = static_cast<std::size_t>(number_of(grid.corner.x(), grid.cell_m));
  const auto row = static_cast<std::size_t>(number_of(grid.corner.y(), grid.cell_m));
  return (row * stride + column) & last_place;
}

}  // namespace

Grid in_ring(const Grid& before, const Grid& grid) {
  Grid now = grid;
  const auto columns = static_cast<std::size_t>(grid.columns);
  const auto rows = static_cast<std::size_t>(grid.rows);
  std::size_t stride = before.stride();
  std::size_t places = before.last_place + 1;  // 0 without a ring
  if (before.cell_m != grid.cell_m || columns > stride || rows * stride > places) {
    // An odd multiple of 8: rows above each other do not compete for the same lines of a cache.
    stride = (roomy(grid.columns) | 15) - 7;
    places = 64;
    while (places < roomy(grid.rows) * stride) places *= 2;
  }
  now.gap = stride - columns;
  now.last_place = places - 1;
  now.first = place_in_ring(grid, stride, now.last_place);
  return now;
}

bool shares_places(const Grid& before, const Grid& now) {
  if (before.last_place == Grid::kNoRing || before.last_place != now.last_place) return false;
  if (before.stride() != now.stride() || before.cell_m != now.cell_m) return false;
  const Cell shift = shift_between(before, now);
  const auto steps =
      static_cast<std::size_t>(shift.row * static_cast<std::int64_t>(now.stride()) + shift.column);
  return ((before.first + steps) & now.last_place) == now.first;
}

}  // namespace clew::map
