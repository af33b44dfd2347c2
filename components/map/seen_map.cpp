// SPDX-License-Identifier: Apache-2.0
#include "map/seen_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace clew::map {
namespace {

/// Bits `first` to `last`, both included, 0 <= first <= last < 64.
std::uint64_t bits_between(std::int32_t first, std::int32_t last) {
  const std::uint64_t up_to_last = ~std::uint64_t{0} >> (63 - last);
  return up_to_last & (~std::uint64_t{0} << first);
}

// As far as this, tiles are looked for column by column, and not one by one.
constexpr double kMostColumns = 1000.0;

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

bool SeenMap::Tile::mark_free(std::size_t row, std::uint64_t bits) {
  if ((bits & ~rows[index(Mark::kFree)][row]) == 0) return false;
  rows[index(Mark::kFree)][row] |= bits;
  rows[index(Mark::kHit)][row] &= ~bits;
  rows[index(Mark::kSuspected)][row] &= ~bits;
  return true;
}

bool SeenMap::Tile::mark_obstacle(Mark mark, std::size_t row, std::size_t column) {
  if (is(mark, row, column)) return false;
  if (mark == Mark::kSuspected && is(Mark::kHit, row, column)) return false;
  const std::uint64_t bit = std::uint64_t{1} << column;
  for (auto& of_mark : rows) of_mark[row] &= ~bit;
  rows[index(mark)][row] |= bit;
  return true;
}

bool is_valid(const SeenMap::State& state) {
  const auto has_one_mark_each = [](const auto& entry) {
    const auto& [free, hit, suspected] = entry.second.rows;
    std::uint64_t twice = 0;
    for (std::size_t row = 0; row < free.size(); ++row) {
      twice |= (free[row] & hit[row]) | (free[row] & suspected[row]) | (hit[row] & suspected[row]);
    }
    return twice == 0;
  };
  return std::all_of(state.tiles.begin(), state.tiles.end(), has_one_mark_each);
}

std::int32_t SeenMap::tile_number(double coordinate_m) const {
  return static_cast<std::int32_t>(std::floor(within_reach(coordinate_m / tile_m())));
}

std::int64_t SeenMap::cell_number(double coordinate_m) const {
  const double cells = kTileCells * within_reach(coordinate_m / cell_m_ / double{kTileCells});
  const auto whole = static_cast<std::int64_t>(cells);
  return static_cast<double>(whole) > cells ? whole - 1 : whole;  // rounded down
}

SeenMap::Place SeenMap::place_of(const Vec2& point) const {
  const std::int64_t column = cell_number(point.x());
  const std::int64_t row = cell_number(point.y());
  const auto tile = [](std::int64_t cell) {
    return static_cast<std::int32_t>((cell < 0 ? cell - (kTileCells - 1) : cell) / kTileCells);
  };
  const TileKey key{tile(column), tile(row)};
  return {key, static_cast<std::size_t>(column - std::int64_t{key.first} * kTileCells),
          static_cast<std::size_t>(row - std::int64_t{key.second} * kTileCells)};
}

SeenMap::Tile* SeenMap::tile_at(const TileKey& key) {
  const auto found = state_.tiles.find(key);
  if (found != state_.tiles.end()) return &found->second;
  if (state_.tiles.size() >= capacity_) return nullptr;
  index_.add(key);
  return &state_.tiles[key];
}

void SeenMap::restore(State state) {
  state_ = std::move(state);
  index_.clear();
  for (auto& [key, tile] : state_.tiles) {
    index_.add(key);
    tile.noted = 0;  // an entry of another map's log says nothing here
  }
  changes_.begin_anew();
}

const SeenMap::Tile* SeenMap::find_tile(const TileKey& key) const {
  const auto found = state_.tiles.find(key);
  return found == state_.tiles.end() ? nullptr : &found->second;
}

/// Takes the obstacles that are not gone out of what is to be marked.
void SeenMap::mark_free(const TileKey& key, Tile& tile, std::size_t row, std::uint64_t bits,
                        const IsGone& is_gone) {
  const Vec2 corner(key.first * tile_m(), key.second * tile_m());
  std::uint64_t obstacles =
      bits & (tile.rows[index(Mark::kHit)][row] | tile.rows[index(Mark::kSuspected)][row]);
  for (; is_gone && obstacles != 0; obstacles &= obstacles - 1) {
    const int column = __builtin_ctzll(obstacles);
    const Vec2 middle = corner + cell_m_ * Vec2(column + 0.5, static_cast<double>(row) + 0.5);
    if (!is_gone(middle)) bits &= ~(std::uint64_t{1} << column);
  }
  if (tile.mark_free(row, bits)) note(key, tile);
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
        const std::uint64_t bits =
            cells_between(cell_m_, std::max(cuts[row].from, cuts[row + 1].from) - left_m,
                          std::min(cuts[row].to, cuts[row + 1].to) - left_m);
        if (bits != 0) mark_free({x, y}, *tile, row, bits, is_gone);
      }
    }
  }
}

void SeenMap::mark_obstacle(const Vec2& point, Mark mark) {
  const Place place = place_of(point);
  Tile* tile = tile_at(place.tile);
  if (tile != nullptr && tile->mark_obstacle(mark, place.row, place.column)) {
    note(place.tile, *tile);
  }
}

double SeenMap::distance_m(const TileKey& key, const Vec2& place) const {
  const Vec2 corner(key.first * tile_m(), key.second * tile_m());
  const Vec2 nearest = place.cwiseMax(corner).cwiseMin(corner + Vec2(tile_m(), tile_m()));
  return core::length(place - nearest);
}

std::optional<SeenMap::Box> SeenMap::box_within(const Vec2& place, double reach_m) const {
  std::optional<Box> box;
  const auto add = [&](std::int32_t column, const TileIndex::Rows& rows) {
    if (!box) box = Box{{column, rows.least}, {column, rows.most}};
    box->least = {std::min(box->least.first, column), std::min(box->least.second, rows.least)};
    box->most = {std::max(box->most.first, column), std::max(box->most.second, rows.most)};
  };
  const auto is_within = [&](const TileKey& key) { return distance_m(key, place) <= reach_m; };
  if (!(reach_m < kMostColumns * tile_m())) {
    for (const auto& [key, tile] : state_.tiles) {
      if (is_within(key)) add(key.first, {key.second, key.second});
    }
    return box;
  }
  const auto reach = static_cast<std::int32_t>(reach_m / tile_m()) + 2;
  const std::int32_t column = tile_number(place.x());
  const std::int32_t row = tile_number(place.y());
  for (std::int32_t x = column - reach; x <= column + reach; ++x) {
    if (!is_within({x, row})) continue;
    // The distance grows with the rows between.
    const double across_m = distance_m({x, row}, place);
    const double along_m = std::sqrt(std::max(0.0, reach_m * reach_m - across_m * across_m));
    std::int32_t first = std::min(row, tile_number(place.y() - along_m));
    std::int32_t last = std::max(row, tile_number(place.y() + along_m));
    while (is_within({x, first - 1})) --first;
    while (!is_within({x, first})) ++first;
    while (is_within({x, last + 1})) ++last;
    while (!is_within({x, last})) --last;
    if (const auto rows = index_.rows_between(x, first, last)) add(x, *rows);
  }
  return box;
}

bool SeenMap::is(Mark mark, const Vec2& point) const {
  const Place place = place_of(point);
  const Tile* tile = find_tile(place.tile);
  return tile != nullptr && tile->is(mark, place.row, place.column);
}

}  // namespace clew::map
