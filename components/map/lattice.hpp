// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/bounded_vector.hpp"
#include "map/grid.hpp"

namespace clew::map {

/// Which cells of a grid are linked. Lagoudakis & Maida 1999 link all units within a radius r.
///
/// *Deviation:* r stays below 2 cells (below the square root of 3 on the hexagonal lattice), since
/// a longer link would reach across an obstacle that is one cell thick. What is left are these
/// three. Eight neighbours may slip between two blocked cells that touch at a corner: who must not,
/// blocks the cells that are nearer to an obstacle than 0.71 cells.
enum class Lattice : std::uint8_t {
  kFourNeighbours,   ///< r = 1
  kEightNeighbours,  ///< r = 1.5, the paper's
  kHexagonal         ///< r = 1; odd rows lie half a cell to the right, rows 0.87 cells apart
};

inline constexpr std::size_t kMaxNeighbours = 8;

/// Weights 1 / distance of the links from a cell to the rows above and below, in 1 / cells; those
/// within its row are 1.
struct RowLinks {
  double left = 0.0;   ///< to the column on the left
  double right = 0.0;  ///< to the column on the right
};

/// The weights of row `row`.
RowLinks row_links(Lattice lattice, std::int32_t row);

/// An upper bound of the largest eigenvalue of the connectivity matrix: its greatest row sum
/// (Gershgorin), which large maps approach. 4, 6.83 and 6.
double eigenvalue_bound(Lattice lattice);

/// How far apart rows are, in cells: 1, or the square root of 3/4.
double row_distance(Lattice lattice);

/// The grid whose cells, laid out in this lattice, cover what `grid` does, as far as whole rows do.
Grid laid_out(Lattice lattice, const Grid& grid);
/// The middle of a cell of a grid that is laid out so.
Vec2 centre(Lattice lattice, const Grid& grid, const Cell& cell);
/// The cell whose row a place lies in, and whose middle is nearest there; none outside the grid.
std::optional<Cell> cell_at(Lattice lattice, const Grid& grid, const Vec2& place);

using Neighbours = core::BoundedVector<Cell, kMaxNeighbours>;

/// The cells that `cell` is linked to, those outside any grid included, always in the same order.
Neighbours neighbours(Lattice lattice, const Cell& cell);

}  // namespace clew::map
