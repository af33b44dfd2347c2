// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/geometry.hpp"

namespace clew::map {

using core::Vec2;

/// Column and row of a square cell; columns along x, rows along y.
struct Cell {
  std::int32_t column = 0;
  std::int32_t row = 0;
};

inline bool operator==(const Cell& a, const Cell& b) {
  return a.column == b.column && a.row == b.row;
}
inline bool operator!=(const Cell& a, const Cell& b) { return !(a == b); }

/// Square cells that tile a rectangle of the plane. Says where cells are, and holds nothing of
/// them: what is known of cells are arrays of size(), row-major from the corner of least x and y.
struct Grid {
  Vec2 corner = Vec2::Zero();  ///< of least x and y, of the whole grid
  double cell_m = 0.05;        ///< side of a cell, > 0
  std::int32_t columns = 0;
  std::int32_t rows = 0;

  std::size_t size() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  bool contains(const Cell& c) const {
    return c.column >= 0 && c.row >= 0 && c.column < columns && c.row < rows;
  }
  /// `c` within the grid.
  std::size_t index(const Cell& c) const {
    return static_cast<std::size_t>(c.row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(c.column);
  }
  Cell cell(std::size_t index) const {
    const auto width = static_cast<std::size_t>(columns);
    return {static_cast<std::int32_t>(index % width), static_cast<std::int32_t>(index / width)};
  }
  /// The middle of a cell, which may lie outside the grid.
  Vec2 centre(const Cell& c) const { return corner + cell_m * Vec2(c.column + 0.5, c.row + 0.5); }
  /// The cell that a place lies in; none outside the grid. A place on a border belongs to the cell
  /// of greater x or y.
  std::optional<Cell> cell_at(const Vec2& place) const;
};

}  // namespace clew::map
