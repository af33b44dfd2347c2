// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

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
  std::optional<Cell> cell_at(const Vec2& place) const {
    const double x = (place.x() - corner.x()) / cell_m;
    const double y = (place.y() - corner.y()) / cell_m;
    if (!(x >= 0.0 && y >= 0.0 && x < columns && y < rows)) return std::nullopt;
    // Truncation is the floor of what is not negative.
    return Cell{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
  }
};

inline bool operator==(const Grid& a, const Grid& b) {
  return a.corner == b.corner && a.cell_m == b.cell_m && a.columns == b.columns && a.rows == b.rows;
}
inline bool operator!=(const Grid& a, const Grid& b) { return !(a == b); }

/// The cells whose middle lies within `radius_m` of a place in the grid; none if it lies outside.
inline void cells_within(const Grid& grid, const Vec2& place, double radius_m,
                         std::vector<Cell>& cells) {
  cells.clear();
  const auto middle = grid.cell_at(place);
  if (!middle) return;
  const auto reach = static_cast<std::int32_t>(std::ceil(radius_m / grid.cell_m));
  for (std::int32_t rows = -reach; rows <= reach; ++rows) {
    for (std::int32_t columns = -reach; columns <= reach; ++columns) {
      const Cell cell{middle->column + columns, middle->row + rows};
      if (grid.contains(cell) && core::length(grid.centre(cell) - place) <= radius_m) {
        cells.push_back(cell);
      }
    }
  }
}

/// Lays the values of the cells of one grid out for another one, whose cells lie a whole number of
/// cells beside. Cells that only the new grid has get `fresh`. `spare` is memory to work in.
template <typename Value>
void lay_out_anew(const Grid& before, const Grid& now, const Value& fresh,
                  std::vector<Value>& values, std::vector<Value>& spare) {
  spare.assign(now.size(), fresh);
  const Vec2 shift = (now.corner - before.corner) / now.cell_m;
  const auto right = static_cast<std::int64_t>(std::llround(shift.x()));
  const auto up = static_cast<std::int64_t>(std::llround(shift.y()));
  const std::int64_t first = std::max<std::int64_t>(0, right);
  const std::int64_t end = std::min<std::int64_t>(before.columns, now.columns + right);
  const std::int64_t end_row = std::min<std::int64_t>(before.rows, now.rows + up);
  for (std::int64_t row = std::max<std::int64_t>(0, up); first < end && row < end_row; ++row) {
    const auto from = values.begin() + (row * before.columns + first);
    std::copy(from, from + (end - first),
              spare.begin() + ((row - up) * now.columns + (first - right)));
  }
  values.swap(spare);
}

}  // namespace clew::map
