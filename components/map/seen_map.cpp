// SPDX-License-Identifier: Apache-2.0
#include "map/seen_map.hpp"

#include <algorithm>
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

void SeenMap::mark_free(const Sector& sector) {
  const core::Vec2 least = sector.least();
  const core::Vec2 most = sector.most();
  for (std::int32_t y = tile_number(least.y()); y <= tile_number(most.y()); ++y) {
    for (std::int32_t x = tile_number(least.x()); x <= tile_number(most.x()); ++x) {
      Tile* tile = tile_at({x, y});
      if (tile == nullptr) continue;
      const double left_m = x * tile_m();
      const double bottom_m = y * tile_m();
      const auto first_row = std::max(0.0, std::floor((least.y() - bottom_m) / cell_m_));
      const auto end_row = std::min<double>(kTileCells, (most.y() - bottom_m) / cell_m_);
      Interval below = sector.at_y(bottom_m + first_row * cell_m_);
      for (auto row = static_cast<std::int32_t>(first_row); row < end_row; ++row) {
        const Interval above = sector.at_y(bottom_m + (row + 1) * cell_m_);
        // A convex set holds a cell if it holds the cell's lower and upper side.
        const double from = std::ceil((std::max(below.from, above.from) - left_m) / cell_m_);
        const double to = std::floor((std::min(below.to, above.to) - left_m) / cell_m_) - 1.0;
        below = above;
        const double first = std::max(0.0, from);
        const double last = std::min(kTileCells - 1.0, to);
        if (!(first <= last)) continue;
        const std::uint64_t bits =
            bits_between(static_cast<std::int32_t>(first), static_cast<std::int32_t>(last));
        const auto r = static_cast<std::size_t>(row);
        tile->rows[index(Mark::kFree)][r] |= bits;
        tile->rows[index(Mark::kHit)][r] &= ~bits;
        tile->rows[index(Mark::kSuspected)][r] &= ~bits;
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
