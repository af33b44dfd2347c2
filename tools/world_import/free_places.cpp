// SPDX-License-Identifier: Apache-2.0
#include "world_import/free_places.hpp"

#include <cstdint>
#include <deque>
#include <vector>

#include "map/room_map.hpp"

namespace clew::world_import {
namespace {

using map::Cell;
using map::Grid;

/// Cells that a breadth-first sweep reaches over free neighbours, in the order in which it does.
std::vector<std::size_t> sweep(const Grid& grid, const std::vector<std::uint8_t>& free,
                               std::size_t from) {
  std::vector<bool> seen(grid.size(), false);
  std::vector<std::size_t> reached = {from};
  seen[from] = true;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const Cell cell = grid.cell(reached[i]);
    for (const Cell& next : {Cell{cell.column + 1, cell.row}, Cell{cell.column - 1, cell.row},
                             Cell{cell.column, cell.row + 1}, Cell{cell.column, cell.row - 1}}) {
      if (!grid.contains(next)) continue;
      const std::size_t index = grid.index(next);
      if (seen[index] || free[index] == 0) continue;
      seen[index] = true;
      reached.push_back(index);
    }
  }
  return reached;
}

}  // namespace

std::optional<std::pair<Vec2, Vec2>> far_places(const CellMap& cells, bool unknown_is_blocked,
                                                double radius_m) {
  map::BlockedMap blocked;
  blocked.grid.cell_m = cells.cell_m;
  blocked.grid.columns = static_cast<std::int32_t>(cells.columns);
  blocked.grid.rows = static_cast<std::int32_t>(cells.rows);
  blocked.blocked.reserve(cells.cells.size());
  for (const CellState state : cells.cells) {
    const bool is_free =
        state == CellState::kFree || (state == CellState::kUnknown && !unknown_is_blocked);
    blocked.blocked.push_back(is_free ? 0 : 1);
  }
  const Grid& grid = blocked.grid;
  std::vector<std::uint8_t> free;
  map::room_around(blocked, radius_m).passable(radius_m, free);

  std::vector<std::size_t> largest;
  std::vector<bool> known(grid.size(), false);
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (known[cell] || free[cell] == 0) continue;
    std::vector<std::size_t> area = sweep(grid, free, cell);
    for (const std::size_t reached : area) known[reached] = true;
    if (area.size() > largest.size()) largest = std::move(area);
  }
  if (largest.empty()) return std::nullopt;
  const std::size_t start = largest.back();
  const std::size_t target = sweep(grid, free, start).back();
  const auto middle = [&](std::size_t index) {
    const Cell cell = grid.cell(index);
    return cells.place(cell.column + 0.5, cell.row + 0.5);
  };
  return std::make_pair(middle(start), middle(target));
}

}  // namespace clew::world_import
