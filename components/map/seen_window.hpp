// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry.hpp"
#include "map/seen_map.hpp"

namespace clew::map {

/// A sector of a disc by the directions of its sides, unit vectors; it opens counter-clockwise from
/// `right` to `left`, by at most pi.
struct Wedge {
  Vec2 right = Vec2::UnitX();
  Vec2 left = Vec2::UnitX();
  double radius_m = 0.0;
};

/// The tiles of a map around one place, for the marks of one scan taken there.
///
/// It computes in cells from the corner of its least tile, with products in place of quotients and
/// directions that were turned. So its numbers differ from those of SeenMap and Sector in the last
/// bits, by far less than kUnsure. A number that lies nearer than that to a border between cells
/// is not decided here: the caller is told so, and asks SeenMap. What is decided is what SeenMap
/// would have decided.
///
/// Most of what a scan shows free was known to be so. Where columns are all free over eight rows is
/// found once, when the window is laid, and a wedge is cut into rows only where it may hold a cell
/// of one that is not. So what is free is marked before obstacles are.
class SeenWindow {
 public:
  /// A cell, counted from the window's corner.
  struct Cell {
    std::int32_t column = 0;
    std::int32_t row = 0;
  };

  /// Lies around a place, of which all that is marked is within `reach_m`. The map stays where it
  /// is until the window is laid again.
  void lay(SeenMap& seen, const Vec2& place, double reach_m);

  /// As SeenMap does, marks the cells that lie wholly within the wedge from the window's place as
  /// free. False if it could not decide on all of them; those that it has marked lie in the wedge.
  bool mark_free(const Wedge& wedge, const SeenMap::IsGone& is_gone);
  /// False where it decides nothing at all, and has no cells: far from the origin.
  bool decides() const { return decides_; }
  /// The cell so far off the window's place; where that lies too near to a border, of the place
  /// itself, whose coordinates `x_m()` and `y_m()` give. Within reach, if the window decides.
  template <typename X, typename Y>
  Cell cell_at(const Vec2& off_m, X&& x_m, Y&& y_m) const {
    const double column = place_.x() + cells_a_metre_ * off_m.x();
    const double row = place_.y() + cells_a_metre_ * off_m.y();
    return {is_near_border(column) ? within(seen_->cell_number(x_m()), first_column_, columns_)
                                   : static_cast<std::int32_t>(column),
            is_near_border(row) ? within(seen_->cell_number(y_m()), first_row_, rows_)
                                : static_cast<std::int32_t>(row)};
  }
  bool is(Mark mark, const Cell& cell) const;
  void mark_obstacle(Mark mark, const Cell& cell);

 private:
  static constexpr double kUnsure = 1e-5;  // of a cell

  /// Where the lower side of a row of cells cuts a wedge.
  struct Cut {
    double from = 0.0;
    double to = 0.0;
  };
  /// How the sides of a wedge bound the cuts: by a slope where there is one.
  struct Sides;
  struct Box {
    Vec2 least;
    Vec2 most;
  };

  static bool is_near_border(double at, double unsure = kUnsure) {
    const double beyond = at - static_cast<double>(static_cast<std::int32_t>(at));
    return beyond < unsure || beyond > 1.0 - unsure;
  }
  static std::int32_t within(std::int64_t cell, std::int32_t first_tile, std::size_t tiles);
  static Sides sides_of(const Wedge& wedge);
  Box box_of(const Wedge& wedge, double radius) const;
  void find_tiles();
  void note_open(std::size_t tile);
  bool touches_open(const Sides& sides, const Box& box, std::int32_t strip) const;
  bool mark_strip_free(const Sides& sides, double squared_radius, std::int32_t first,
                       std::int32_t end, const SeenMap::IsGone& is_gone);
  bool make_tiles(const Box& box);
  Cut cut_at(const Sides& sides, double squared_radius, std::int32_t row) const;
  bool is_row_free(std::size_t first_tile, std::int32_t row, std::int32_t first,
                   std::int32_t end) const;
  void mark_row_free(std::int32_t row, std::int32_t first, std::int32_t end,
                     const SeenMap::IsGone& is_gone);
  SeenMap::TileKey key_of(std::size_t index) const;
  std::size_t index_of(const Cell& cell) const;

  SeenMap* seen_ = nullptr;
  bool decides_ = false;  // false: too far out, or too wide, for its arithmetic
  double cells_a_metre_ = 0.0;
  double reach_ = 0.0;  // this and all that follows in cells
  Vec2 place_ = Vec2::Zero();
  std::int32_t first_column_ = 0;  // of tiles
  std::int32_t first_row_ = 0;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<SeenMap::Tile*> tiles_;  // by row and column; null if there is none
  // By strip of eight rows, from below, and by column of tiles: bit i is set if not all cells of
  // column i are free there.
  std::vector<std::uint64_t> open_;
};

}  // namespace clew::map
