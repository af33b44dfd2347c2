// SPDX-License-Identifier: Apache-2.0
#include "map/lattice.hpp"

#include <cmath>

namespace clew::map {

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
