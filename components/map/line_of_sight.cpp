// SPDX-License-Identifier: Apache-2.0
#include "map/line_of_sight.hpp"

#include <cmath>
#include <limits>

namespace clew::map {
namespace {

/// How a line proceeds along one axis, in fractions of its length.
struct Progress {
  std::int32_t step = 0;
  double next = std::numeric_limits<double>::infinity();  ///< where it enters the next cell
  double a_cell = std::numeric_limits<double>::infinity();
};

Progress progress(double from, double to, std::int32_t cell) {
  Progress along;
  if (from == to) return along;
  along.step = to > from ? 1 : -1;
  along.a_cell = 1.0 / std::fabs(to - from);
  along.next = std::fabs((to > from ? cell + 1 : cell) - from) * along.a_cell;
  return along;
}

}  // namespace

bool line_of_sight(const Grid& grid, const std::vector<std::uint8_t>& passable, const Vec2& from,
                   const Vec2& to) {
  const auto first = grid.cell_at(from);
  const auto last = grid.cell_at(to);
  if (!first.has_value() || !last.has_value()) return false;
  const Vec2 begin = (from - grid.corner) / grid.cell_m;
  const Vec2 end = (to - grid.corner) / grid.cell_m;
  Progress x = progress(begin.x(), end.x(), first->column);
  Progress y = progress(begin.y(), end.y(), first->row);
  Cell cell = *first;
  // As many borders of cells as there are between both ends; rounding cannot make it more.
  std::int32_t borders = std::abs(last->column - cell.column) + std::abs(last->row - cell.row);
  for (; borders > 1; --borders) {
    Progress& nearer = x.next < y.next ? x : y;
    (&nearer == &x ? cell.column : cell.row) += nearer.step;
    nearer.next += nearer.a_cell;
    if (!grid.contains(cell) || passable[grid.index(cell)] == 0) return false;
  }
  return true;
}

}  // namespace clew::map
