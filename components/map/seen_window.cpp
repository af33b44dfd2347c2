// SPDX-License-Identifier: Apache-2.0
#include "map/seen_window.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/check.hpp"

namespace clew::map {
namespace {

constexpr double kCellsOfTile = SeenMap::kTileCells;
constexpr std::int32_t kStripRows = 8;
constexpr std::size_t kStripsOfTile = SeenMap::kTileCells / kStripRows;
// How far roundings move the ends of a row, at most.
constexpr double kRounding_cells = 1e-3;
// Numbers farther from the map's origin have too few bits behind the point: 25 km of 25 mm.
constexpr double kFarthest_cells = 1e6;
constexpr double kMostReach_cells = 1e4;
// A side so near to a row's direction crosses it at a place that its rounding moves.
constexpr double kLeastRise = 1e-3;

/// Where within its tile a column or row is.
std::size_t line_of(std::int32_t cell) {
  return static_cast<std::size_t>(cell % SeenMap::kTileCells);
}

}  // namespace

/// Slopes are columns a row. A side that bounds nothing there bounds infinitely far away.
struct SeenWindow::Sides {
  bool right_is_up = false;
  bool left_is_up = false;
  double right = 0.0;
  double left = 0.0;
};

void SeenWindow::lay(SeenMap& seen, const Vec2& place, double reach_m) {
  seen_ = &seen;
  cells_a_metre_ = 1.0 / seen.cell_m();
  reach_ = reach_m * cells_a_metre_ + 2.0;
  const Vec2 from_origin = cells_a_metre_ * place;
  decides_ = std::fabs(from_origin.x()) <= kFarthest_cells &&
             std::fabs(from_origin.y()) <= kFarthest_cells && reach_ <= kMostReach_cells;
  if (!decides_) return;
  const auto tile = [](double cells) {
    return static_cast<std::int32_t>(std::floor(cells / kCellsOfTile));
  };
  first_column_ = tile(from_origin.x() - reach_);
  first_row_ = tile(from_origin.y() - reach_);
  columns_ = static_cast<std::size_t>(tile(from_origin.x() + reach_) - first_column_ + 1);
  rows_ = static_cast<std::size_t>(tile(from_origin.y() + reach_) - first_row_ + 1);
  place_ = from_origin - kCellsOfTile * Vec2(first_column_, first_row_);
  find_tiles();
}

void SeenWindow::find_tiles() {
  tiles_.assign(columns_ * rows_, nullptr);
  open_.assign(columns_ * rows_ * kStripsOfTile, ~std::uint64_t{0});
  const SeenMap::TileKey first = key_of(0);
  seen_->for_each_tile(first, key_of(tiles_.size() - 1),
                       [&](const SeenMap::TileKey& key, SeenMap::Tile& tile) {
                         const auto column = static_cast<std::size_t>(key.first - first.first);
                         const auto row = static_cast<std::size_t>(key.second - first.second);
                         tiles_[row * columns_ + column] = &tile;
                         note_open(row * columns_ + column);
                       });
}

/// Finds the columns of a tile's strips that are not all free.
void SeenWindow::note_open(std::size_t tile) {
  const std::uint64_t* free = tiles_[tile]->rows[static_cast<std::size_t>(Mark::kFree)].data();
  std::uint64_t* open = &open_[tile / columns_ * kStripsOfTile * columns_ + tile % columns_];
  for (std::size_t strip = 0; strip < kStripsOfTile; ++strip) {
    std::uint64_t all = ~std::uint64_t{0};
    for (std::size_t i = 0; i < kStripRows; ++i) all &= free[strip * kStripRows + i];
    open[strip * columns_] = ~all;
  }
}

SeenWindow::Sides SeenWindow::sides_of(const Wedge& wedge) {
  return {wedge.right.y() > 0.0, wedge.left.y() > 0.0, wedge.right.x() / wedge.right.y(),
          wedge.left.x() / wedge.left.y()};
}

SeenWindow::Box SeenWindow::box_of(const Wedge& wedge, double radius) const {
  const Vec2& right = wedge.right;
  const Vec2& left = wedge.left;
  Vec2 least = radius * right.cwiseMin(left).cwiseMin(Vec2::Zero());
  Vec2 most = radius * right.cwiseMax(left).cwiseMax(Vec2::Zero());
  // The arc goes beyond its ends along the axes that it crosses.
  if (right.y() < 0.0 && left.y() > 0.0) most.x() = radius;
  if (right.y() > 0.0 && left.y() < 0.0) least.x() = -radius;
  if (right.x() > 0.0 && left.x() < 0.0) most.y() = radius;
  if (right.x() < 0.0 && left.x() > 0.0) least.y() = -radius;
  return {place_ + least, place_ + most};
}

/// Makes the tiles of a box, in the order in which SeenMap does. False if it is unsure which.
bool SeenWindow::make_tiles(const Box& box) {
  const Vec2 first = box.least / kCellsOfTile;
  const Vec2 last = box.most / kCellsOfTile;
  constexpr double kUnsureTiles = kUnsure / kCellsOfTile;
  for (const double at : {first.x(), first.y(), last.x(), last.y()}) {
    if (is_near_border(at, kUnsureTiles)) return false;
  }
  const auto whole = [](double tiles) { return static_cast<std::size_t>(tiles); };
  for (std::size_t row = whole(first.y()); row <= whole(last.y()); ++row) {
    for (std::size_t column = whole(first.x()); column <= whole(last.x()); ++column) {
      const std::size_t index = row * columns_ + column;
      if (tiles_[index] == nullptr) tiles_[index] = seen_->tile_at(key_of(index));
    }
  }
  return true;
}

inline SeenWindow::Cut SeenWindow::cut_at(const Sides& sides, double squared_radius,
                                          std::int32_t row) const {
  const double y = row - place_.y();
  const double square = squared_radius - y * y;
  if (square < 0.0) return {HUGE_VAL, -HUGE_VAL};
  const double at_right = sides.right * y;
  const double at_left = sides.left * y;
  double from =
      std::max(sides.right_is_up ? -HUGE_VAL : at_right, sides.left_is_up ? at_left : -HUGE_VAL);
  double to =
      std::min(sides.right_is_up ? at_right : HUGE_VAL, sides.left_is_up ? HUGE_VAL : at_left);
  // Most rows are bounded by both sides, and need no root.
  if (from * from > square || to * to > square) {
    const double half = std::sqrt(square);
    from = std::max(from, -half);
    to = std::min(to, half);
  }
  return {place_.x() + from, place_.x() + to};
}

bool SeenWindow::mark_free(const Wedge& wedge, const SeenMap::IsGone& is_gone) {
  const double radius = wedge.radius_m * cells_a_metre_;
  const bool decides = decides_ && radius <= reach_ - 1.0 &&
                       std::fabs(wedge.right.y()) >= kLeastRise &&
                       std::fabs(wedge.left.y()) >= kLeastRise;
  if (!decides) return false;
  const Box box = box_of(wedge, radius);
  if (!make_tiles(box)) return false;
  const Sides sides = sides_of(wedge);
  const auto first = static_cast<std::int32_t>(box.least.y());
  const auto end = static_cast<std::int32_t>(box.most.y()) + 1;
  for (std::int32_t strip = first - first % kStripRows; strip < end; strip += kStripRows) {
    if (!touches_open(sides, box, strip)) continue;
    if (!mark_strip_free(sides, radius * radius, std::max(first, strip),
                         std::min(end, strip + kStripRows), is_gone)) {
      return false;
    }
  }
  return true;
}

/// Whether the part of a wedge in the strip from that row on may hold a cell that is not free.
bool SeenWindow::touches_open(const Sides& sides, const Box& box, std::int32_t strip) const {
  const double low = std::max<double>(strip, box.least.y()) - place_.y();
  const double high = std::min<double>(strip + kStripRows, box.most.y()) - place_.y();
  double from = box.least.x() - place_.x();
  double to = box.most.x() - place_.x();
  const auto bound = [&](double slope, bool from_left) {
    const double at_low = slope * low;
    const double at_high = slope * high;
    if (from_left) {
      from = std::max(from, std::min(at_low, at_high));
    } else {
      to = std::min(to, std::max(at_low, at_high));
    }
  };
  bound(sides.right, !sides.right_is_up);
  bound(sides.left, sides.left_is_up);
  if (from > to) return false;
  // A cell is held if both its sides are.
  const auto first = static_cast<std::size_t>(place_.x() + from - kRounding_cells) + 1;
  const auto end = static_cast<std::size_t>(place_.x() + to + kRounding_cells);
  if (first >= end) return false;
  constexpr std::size_t kCells = SeenMap::kTileCells;
  const std::uint64_t* open = &open_[static_cast<std::size_t>(strip / kStripRows) * columns_];
  const std::size_t last = end - 1;
  const std::uint64_t from_first = ~std::uint64_t{0} << first % kCells;
  const std::uint64_t to_last = ~std::uint64_t{0} >> (kCells - 1 - last % kCells);
  if (first / kCells == last / kCells) {
    return (open[first / kCells] & from_first & to_last) != 0;
  }
  std::uint64_t found = (open[first / kCells] & from_first) | (open[last / kCells] & to_last);
  for (std::size_t tile = first / kCells + 1; tile < last / kCells; ++tile) found |= open[tile];
  return found != 0;
}

/// The same within the rows from `first` to before `end`.
bool SeenWindow::mark_strip_free(const Sides& sides, double squared_radius, std::int32_t first,
                                 std::int32_t end, const SeenMap::IsGone& is_gone) {
  const std::size_t first_tile = index_of({0, first});
  Cut below = cut_at(sides, squared_radius, first);
  for (std::int32_t row = first; row < end; ++row) {
    // A convex set holds a cell if it holds the cell's lower and upper side.
    const Cut above = cut_at(sides, squared_radius, row + 1);
    const double from = std::max(below.from, above.from);
    const double to = std::min(below.to, above.to);
    below = above;
    if (!(to - from >= 1.0 - kUnsure)) continue;
    if (is_near_border(from, kUnsure) || is_near_border(to, kUnsure)) return false;
    const std::int32_t first_cell = static_cast<std::int32_t>(from) + 1;
    const std::int32_t end_cell = static_cast<std::int32_t>(to);
    if (!is_row_free(first_tile, row, first_cell, end_cell)) {
      mark_row_free(row, first_cell, end_cell, is_gone);
    }
  }
  return true;
}

/// Whether the cells of a row from `first` to before `end` are free already, as far as that is told
/// at a glance: most lie in one tile. `first_tile` is the first one of that row of tiles.
inline bool SeenWindow::is_row_free(std::size_t first_tile, std::int32_t row, std::int32_t first,
                                    std::int32_t end) const {
  if (first >= end) return true;
  const std::int32_t column = first / SeenMap::kTileCells;
  if (column != (end - 1) / SeenMap::kTileCells) return false;
  const SeenMap::Tile* tile = tiles_[first_tile + static_cast<std::size_t>(column)];
  if (tile == nullptr) return true;
  const std::uint64_t bits = ~std::uint64_t{0} >> (SeenMap::kTileCells - (end - first))
                                                      << first % SeenMap::kTileCells;
  return (bits & ~tile->rows[static_cast<std::size_t>(Mark::kFree)][line_of(row)]) == 0;
}

/// Marks the cells of a row from `first` to before `end`.
void SeenWindow::mark_row_free(std::int32_t row, std::int32_t first, std::int32_t end,
                               const SeenMap::IsGone& is_gone) {
  while (first < end) {
    const std::int32_t bit = first % SeenMap::kTileCells;
    const std::int32_t count = std::min(SeenMap::kTileCells - bit, end - first);
    const std::uint64_t bits = ~std::uint64_t{0} >> (SeenMap::kTileCells - count) << bit;
    const std::size_t index = index_of({first, row});
    SeenMap::Tile* tile = tiles_[index];
    constexpr auto kFree = static_cast<std::size_t>(Mark::kFree);
    if (tile != nullptr && (bits & ~tile->rows[kFree][line_of(row)]) != 0) {
      seen_->mark_free(key_of(index), *tile, line_of(row), bits, is_gone);
    }
    first += count;
  }
}

/// Of a cell counted from the origin, its number from the window's corner.
std::int32_t SeenWindow::within(std::int64_t cell, std::int32_t first_tile, std::size_t tiles) {
  const std::int64_t corner = std::int64_t{first_tile} * SeenMap::kTileCells;
  const auto size = static_cast<std::int64_t>(tiles) * SeenMap::kTileCells;
  CLEW_CHECK(cell >= corner && cell < corner + size,
             "cell " + std::to_string(cell) + " lies outside of " + std::to_string(size) +
                 " from " + std::to_string(corner));
  return static_cast<std::int32_t>(cell - corner);
}

bool SeenWindow::is(Mark mark, const Cell& cell) const {
  const SeenMap::Tile* tile = tiles_[index_of(cell)];
  if (tile == nullptr) tile = seen_->find_tile(key_of(index_of(cell)));
  return tile != nullptr && tile->is(mark, line_of(cell.row), line_of(cell.column));
}

void SeenWindow::mark_obstacle(Mark mark, const Cell& cell) {
  SeenMap::Tile*& tile = tiles_[index_of(cell)];
  if (tile == nullptr) tile = seen_->tile_at(key_of(index_of(cell)));
  if (tile == nullptr) return;
  if (tile->mark_obstacle(mark, line_of(cell.row), line_of(cell.column))) {
    seen_->note(key_of(index_of(cell)), *tile);
  }
}

SeenMap::TileKey SeenWindow::key_of(std::size_t index) const {
  return {first_column_ + static_cast<std::int32_t>(index % columns_),
          first_row_ + static_cast<std::int32_t>(index / columns_)};
}

std::size_t SeenWindow::index_of(const Cell& cell) const {
  return static_cast<std::size_t>(cell.row / SeenMap::kTileCells) * columns_ +
         static_cast<std::size_t>(cell.column / SeenMap::kTileCells);
}

}  // namespace clew::map
