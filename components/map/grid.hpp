// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
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
/// them: what is known of cells are arrays of size(), row-major from the corner of least x and y;
/// or, of a grid that moves, laid out in a ring (see in_ring()).
struct Grid {
  Vec2 corner = Vec2::Zero();  ///< of least x and y, of the whole grid
  double cell_m = 0.05;        ///< side of a cell, > 0
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  /// Where the arrays hold a cell: from `first` on, rows follow each other with `gap` places
  /// between them, and after the place `last_place` comes place 0.
  std::size_t first = 0;
  std::size_t gap = 0;
  std::size_t last_place = kNoRing;

  static constexpr std::size_t kNoRing = std::numeric_limits<std::size_t>::max();

  /// Of arrays that hold something of each cell.
  std::size_t size() const {
    if (last_place != kNoRing) return last_place + 1;
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  /// From a place to that of the cell above.
  std::size_t stride() const { return static_cast<std::size_t>(columns) + gap; }
  bool contains(const Cell& c) const {
    return c.column >= 0 && c.row >= 0 && c.column < columns && c.row < rows;
  }
  /// `c` within the grid.
  std::size_t index(const Cell& c) const {
    return (first + static_cast<std::size_t>(c.row) * stride() +
            static_cast<std::size_t>(c.column)) &
           last_place;
  }
  /// `index` of a cell of the grid.
  Cell cell(std::size_t index) const {
    const auto place = static_cast<std::uint32_t>((index - first) & last_place);
    const auto width = static_cast<std::uint32_t>(stride());
    return {static_cast<std::int32_t>(place % width), static_cast<std::int32_t>(place / width)};
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

/// Whether they have the same cells, wherever arrays hold them.
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

/// How many columns and rows the corner of one grid lies beside that of another, whose cells lie a
/// whole number of cells beside.
inline Cell shift_between(const Grid& before, const Grid& now) {
  const auto cells = [](double shift) {
    constexpr double kFarthest = 1 << 30;  // farther than any two that share a cell
    return static_cast<std::int32_t>(std::llround(std::clamp(shift, -kFarthest, kFarthest)));
  };
  const Vec2 shift = (now.corner - before.corner) / now.cell_m;
  return {cells(shift.x()), cells(shift.y())};
}

/// The grid, with its arrays in a ring: a cell's place in them depends on where in the plane it
/// lies, and not on where the grid begins. So a grid that moves on leaves what it keeps where it
/// is: see lay_out_anew(). It takes the ring of `before`, if it fits.
Grid in_ring(const Grid& before, const Grid& grid);

/// Whether the cells that two grids share have the same places.
bool shares_places(const Grid& before, const Grid& now);

/// Calls `visit(cell, count)` for each row's run of cells, from `cell` on, that one grid has and
/// the other has not.
template <typename Visit>
void for_each_run_left(const Grid& before, const Grid& now, Visit&& visit) {
  const Cell shift = shift_between(before, now);
  const auto within = [&](std::int32_t column) { return std::clamp(column, 0, before.columns); };
  const std::int32_t first = within(shift.column);
  const std::int32_t end = within(shift.column + now.columns);
  for (std::int32_t row = 0; row < before.rows; ++row) {
    if (row < shift.row || row >= shift.row + now.rows || first >= end) {
      visit(Cell{0, row}, before.columns);
      continue;
    }
    if (first > 0) visit(Cell{0, row}, first);
    if (end < before.columns) visit(Cell{end, row}, before.columns - end);
  }
}

/// Sets the values of so many cells of a row, from one on.
template <typename Value>
void fill_run(const Grid& grid, const Cell& cell, std::int32_t count, const Value& value,
              std::vector<Value>& values) {
  const std::size_t place = grid.index(cell);
  const auto all = static_cast<std::size_t>(count);
  const std::size_t ahead = std::min(all, grid.size() - place);
  std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(place), ahead, value);
  std::fill_n(values.begin(), all - ahead, value);
}

/// Lays the values of the cells of one grid out for another one, whose cells lie a whole number of
/// cells beside. Cells that only the new grid has get `fresh`, and in a ring all places have that
/// no cell has. `spare` is memory to work in.
template <typename Value>
void lay_out_anew(const Grid& before, const Grid& now, const Value& fresh,
                  std::vector<Value>& values, std::vector<Value>& spare) {
  if (shares_places(before, now)) {
    for_each_run_left(before, now, [&](const Cell& cell, std::int32_t count) {
      fill_run(before, cell, count, fresh, values);
    });
    return;
  }
  spare.assign(now.size(), fresh);
  const Cell shift = shift_between(before, now);
  const std::int32_t first = std::max(0, shift.column);
  const std::int32_t end = std::min(before.columns, now.columns + shift.column);
  const std::int32_t end_row = std::min(before.rows, now.rows + shift.row);
  for (std::int32_t row = std::max(0, shift.row); row < end_row; ++row) {
    for (std::int32_t column = first; column < end; ++column) {
      spare[now.index({column - shift.column, row - shift.row})] =
          values[before.index({column, row})];
    }
  }
  values.swap(spare);
}

}  // namespace clew::map
