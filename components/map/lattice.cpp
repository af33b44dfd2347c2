// SPDX-License-Identifier: Apache-2.0
#include "map/lattice.hpp"

#include <cmath>

namespace clew::map {
namespace {

// How far a row lies to the right, in cells.
double row_shift(Lattice lattice, std::int32_t row) {
  return lattice == Lattice::kHexagonal && row % 2 != 0 ? 0.5 : 0.0;
}

}  // namespace

RowLinks row_links(Lattice lattice, std::int32_t row) {
  switch (lattice) {
    case Lattice::kFourNeighbours:
      return {0.0, 0.0};
    case Lattice::kHexagonal:
      return row % 2 == 0 ? RowLinks{1.0, 0.0} : RowLinks{0.0, 1.0};
    case Lattice::kEightNeighbours:
      break;
  }
  return {std::sqrt(0.5), std::sqrt(0.5)};
}

double eigenvalue_bound(Lattice lattice) {
  const RowLinks links = row_links(lattice, 0);
  return 2.0 + 2.0 * (1.0 + links.left + links.right);
}

double row_distance(Lattice lattice) {
  return lattice == Lattice::kHexagonal ? std::sqrt(0.75) : 1.0;
}

Grid laid_out(Lattice lattice, const Grid& grid) {
  Grid laid = grid;
  laid.rows = static_cast<std::int32_t>(std::floor(grid.rows / row_distance(lattice)));
  return laid;
}

Vec2 centre(Lattice lattice, const Grid& grid, const Cell& cell) {
  return grid.corner + grid.cell_m * Vec2(cell.column + 0.5 + row_shift(lattice, cell.row),
                                          (cell.row + 0.5) * row_distance(lattice));
}

std::optional<Cell> cell_at(Lattice lattice, const Grid& grid, const Vec2& place) {
  const Vec2 steps = (place - grid.corner) / grid.cell_m;
  const double row = std::floor(steps.y() / row_distance(lattice));
  if (!(row >= 0.0 && row < grid.rows)) return std::nullopt;
  const auto whole_row = static_cast<std::int32_t>(row);
  const double column = std::floor(steps.x() - row_shift(lattice, whole_row));
  if (!(column >= 0.0 && column < grid.columns)) return std::nullopt;
  return Cell{static_cast<std::int32_t>(column), whole_row};
}

Neighbours neighbours(Lattice lattice, const Cell& cell) {
  Neighbours found;
  found.push_back({cell.column - 1, cell.row});
  found.push_back({cell.column + 1, cell.row});
  const RowLinks links = row_links(lattice, cell.row);
  for (const std::int32_t row : {cell.row - 1, cell.row + 1}) {
    found.push_back({cell.column, row});
    if (links.left > 0.0) found.push_back({cell.column - 1, row});
    if (links.right > 0.0) found.push_back({cell.column + 1, row});
  }
  return found;
}

}  // namespace clew::map
