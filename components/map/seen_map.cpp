// SPDX-License-Identifier: Apache-2.0
#include "map/seen_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace clew::map {
namespace {

/// Bits `first` to `last`, both included, 0 <= first <= last < 64.
std::uint64_t bits_between(std::int32_t first, std::int32_t last) {
  const std::uint64_t up_to_last = ~std::uint64_t{0} >> (63 - last);
  return up_to_last & (~std::uint64_t{0} << first);
}

/// The number of a tile, or of a place between two: beyond it numbers have no room. A place so far
/// away comes from a file only.
double within_reach(double tiles) {
  constexpr double kFarthest = 1 << 30;
  return std::clamp(tiles, -kFarthest, kFarthest);
}

std::size_t index(Mark mark) { return static_cast<std::size_t>(mark); }

/// The cells of a tile's row that lie wholly between two places, measured from the tile.
std::uint64_t cells_between(double cell_m, double from_m, double to_m) {
  const double from = std::max(0.0, from_m / cell_m);
  const double to = std::min<double>(SeenMap::kTileCells, to_m / cell_m);
  if (!(from <= SeenMap::kTileCells - 1.0) || !(to >= 1.0)) return 0;
  const auto whole = static_cast<std::int32_t>(from);
  const std::int32_t first = whole < from ? whole + 1 : whole;
  const std::int32_t last = static_cast<std::int32_t>(to) - 1;
  return first > last ? 0 : bits_between(first, last);
}

}  // namespace

std::int32_t SeenMap::tile_number(double coordinate_m) const {
  return static_cast<std::int32_t>(std::floor(within_reach(coordinate_m / tile_m())));
}

SeenMap::Place SeenMap::place_of(const Vec2& point) const {
  const double cells = kTileCells;
  const auto column =
      static_cast<std::int64_t>(std::floor(cells * within_reach(point.x() / cell_m_ / cells)));
  const auto row =
      static_cast<std::int64_t>(std::floor(cells * within_reach(point.y() / cell_m_ / cells)));
  const auto tile = [](std::int64_t cell) {
    return static_cast<std::int32_t>(
        std::floor(static_cast<double>(cell) / static_cast<double>(kTileCells)));
  };
  const TileKey key{tile(column), tile(row)};
  return {key, static_cast<std::size_t>(column - std::int64_t{key.first} * kTileCells),
          static_cast<std::size_t>(row - std::int64_t{key.second} * kTileCells)};
}

/// The tile, made if there is room; else null.
SeenMap::Tile* SeenMap::tile_at(const TileKey& key) {
  const auto found = state_.tiles.find(key);
  if (found != state_.tiles.end()) return &found->second;
  if (state_.tiles.size() >= capacity_) return nullptr;
  return &state_.tiles[key];
}

/// Takes the obstacles that are not gone out of what is to be marked in a row.
void SeenMap::keep_obstacles(const TileKey& key, const Tile& tile, std::size_t row,
                             const IsGone& is_gone, std::uint64_t& bits) const {
  const Vec2 corner(key.first * tile_m(), key.second * tile_m());
  std::uint64_t obstacles =
      bits & (tile.rows[index(Mark::kHit)][row] | tile.rows[index(Mark::kSuspected)][row]);
  for (; obstacles != 0; obstacles &= obstacles - 1) {
    const int column = __builtin_ctzll(obstacles);
    const Vec2 middle = corner + cell_m_ * Vec2(column + 0.5, static_cast<double>(row) + 0.5);
    if (!is_gone(middle)) bits &= ~(std::uint64_t{1} << column);
  }
}

void SeenMap::mark_free(const Sector& sector, const IsGone& is_gone) {
  const core::Vec2 least = sector.least();
  const core::Vec2 most = sector.most();
  // Where the lower sides of a row of tiles' rows cut the sector, and the upper side of the last.
  std::array<Interval, kTileCells + 1> cuts;
  for (std::int32_t y = tile_number(least.y()); y <= tile_number(most.y()); ++y) {
    const double bottom_m = y * tile_m();
    const auto first_row =
        static_cast<std::size_t>(std::max(0.0, std::floor((least.y() - bottom_m) / cell_m_)));
    const auto end_row = std::min<double>(kTileCells, (most.y() - bottom_m) / cell_m_);
    std::size_t end = first_row;
    while (static_cast<double>(end) < end_row) ++end;
    for (std::size_t row = first_row; row <= end && row < cuts.size(); ++row) {
      cuts[row] = sector.at_y(bottom_m + static_cast<double>(row) * cell_m_);
    }
    for (std::int32_t x = tile_number(least.x()); x <= tile_number(most.x()); ++x) {
      Tile* tile = tile_at({x, y});
      if (tile == nullptr) continue;
      const double left_m = x * tile_m();
      for (std::size_t row = first_row; row < end; ++row) {
        // A convex set holds a cell if it holds the cell's lower and upper side.
        std::uint64_t bits =
            cells_between(cell_m_, std::max(cuts[row].from, cuts[row + 1].from) - left_m,
                          std::min(cuts[row].to, cuts[row + 1].to) - left_m);
        if (bits == 0) continue;
        if (is_gone) keep_obstacles({x, y}, *tile, row, is_gone, bits);
        tile->rows[index(Mark::kFree)][row] |= bits;
        tile->rows[index(Mark::kHit)][row] &= ~bits;
        tile->rows[index(Mark::kSuspected)][row] &= ~bits;
      }
    }
  }
}

void SeenMap::mark_obstacle(const Vec2& point, Mark mark) {
  const Place place = place_of(point);
  Tile* tile = tile_at(place.tile);
  if (tile == nullptr) return;
  const std::uint64_t bit = std::uint64_t{1} << place.column;
  if (mark == Mark::kSuspected && (tile->rows[index(Mark::kHit)][place.row] & bit) != 0) return;
  for (auto& rows : tile->rows) rows[place.row] &= ~bit;
  tile->rows[index(mark)][place.row] |= bit;
}

double SeenMap::distance_m(const TileKey& key, const Vec2& place) const {
  const Vec2 corner(key.first * tile_m(), key.second * tile_m());
  const Vec2 nearest = place.cwiseMax(corner).cwiseMin(corner + Vec2(tile_m(), tile_m()));
  return core::length(place - nearest);
}

bool SeenMap::is(Mark mark, const Vec2& point) const {
  const Place place = place_of(point);
  const auto found = state_.tiles.find(place.tile);
  if (found == state_.tiles.end()) return false;
  return (found->second.rows[index(mark)][place.row] >> place.column & 1) != 0;
}

}  // namespace clew::map
