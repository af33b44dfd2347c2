// SPDX-License-Identifier: Apache-2.0
#include "world_import/cell_world.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "core/math.hpp"

namespace clew::world_import {
namespace {

/// A block of cells, ends not included.
struct Block {
  std::size_t first_column = 0;
  std::size_t end_column = 0;
  std::size_t first_row = 0;
  std::size_t end_row = 0;
};

/// Covers the blocked cells with blocks, each cell once: runs of a row, joined with the same run of
/// the rows above.
std::vector<Block> blocks_of(const CellMap& map, bool unknown_is_blocked) {
  const auto is_blocked = [&](std::size_t column, std::size_t row) {
    const CellState state = map.at(column, row);
    return state == CellState::kOccupied || (state == CellState::kUnknown && unknown_is_blocked);
  };
  std::vector<Block> done;
  std::vector<Block> open;  ///< that end at the row below, by column
  for (std::size_t row = 0; row < map.rows; ++row) {
    std::vector<Block> now;
    for (std::size_t column = 0; column < map.columns;) {
      if (!is_blocked(column, row)) {
        ++column;
        continue;
      }
      Block run{column, column, row, row + 1};
      while (run.end_column < map.columns && is_blocked(run.end_column, row)) ++run.end_column;
      column = run.end_column;
      now.push_back(run);
    }
    for (const Block& below : open) {
      const auto same = std::find_if(now.begin(), now.end(), [&](const Block& run) {
        return run.first_column == below.first_column && run.end_column == below.end_column;
      });
      if (same == now.end()) {
        done.push_back(below);
      } else {
        same->first_row = below.first_row;
      }
    }
    open = std::move(now);
  }
  done.insert(done.end(), open.begin(), open.end());
  return done;
}

/// What a turned rectangle leaves of its bounding box: a triangle at each corner of the box.
void block_corners(const std::array<Vec2, 4>& corners, WorldDraft& draft) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2& a = corners[i];
    const Vec2& b = corners[(i + 1) % corners.size()];
    // One of the two other corners of the side's box lies outside the rectangle: the one to the
    // right of the side, which goes counter-clockwise.
    for (const Vec2& corner : {Vec2(a.x(), b.y()), Vec2(b.x(), a.y())}) {
      const Vec2 side = b - a;
      const Vec2 to_corner = corner - a;
      if (side.x() * to_corner.y() - side.y() * to_corner.x() < -1e-9) {
        draft.polygons.push_back({a, corner, b});
      }
    }
  }
}

}  // namespace

Vec2 CellMap::place(double column, double row) const {
  const double c = core::cos(origin.heading_rad);
  const double s = core::sin(origin.heading_rad);
  const double x = column * cell_m;
  const double y = row * cell_m;
  return {origin.x_m + c * x - s * y, origin.y_m + s * x + c * y};
}

WorldDraft world_of(const CellMap& map, bool unknown_is_blocked) {
  const auto columns = static_cast<double>(map.columns);
  const auto rows = static_cast<double>(map.rows);
  const std::array<Vec2, 4> corners = {map.place(0, 0), map.place(columns, 0),
                                       map.place(columns, rows), map.place(0, rows)};
  WorldDraft draft;
  draft.bounds_min = draft.bounds_max = corners[0];
  for (const Vec2& corner : corners) {
    draft.bounds_min = draft.bounds_min.cwiseMin(corner);
    draft.bounds_max = draft.bounds_max.cwiseMax(corner);
  }
  for (const Block& block : blocks_of(map, unknown_is_blocked)) {
    const auto left = static_cast<double>(block.first_column);
    const auto right = static_cast<double>(block.end_column);
    const auto low = static_cast<double>(block.first_row);
    const auto high = static_cast<double>(block.end_row);
    draft.polygons.push_back({map.place(left, low), map.place(right, low), map.place(right, high),
                              map.place(left, high)});
  }
  if (map.origin.heading_rad != 0.0) block_corners(corners, draft);
  return draft;
}

}  // namespace clew::world_import
