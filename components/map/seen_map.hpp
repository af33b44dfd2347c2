// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "core/archive.hpp"
#include "core/geometry.hpp"
#include "map/sector.hpp"
#include "map/tile_index.hpp"
#include "map/tile_log.hpp"

namespace clew::map {

using core::Vec2;

/// What is known of a cell. A cell that nothing was learnt of is unknown: none of the three.
enum class Mark : std::uint8_t {
  kFree,      ///< all of it lay within a beam's free part
  kHit,       ///< an obstacle is here, known to within half of hit_spread_m
  kSuspected  ///< an obstacle may be here, or elsewhere on the same arc
};
inline constexpr std::size_t kMarks = 3;

/// What was seen of the plane, in square cells that lie side by side from the origin of the frame.
/// It grows by tiles of 64 by 64 cells as the robot sees more, so that memory is a matter of the
/// area seen: 1.5 KiB for 64^2 cells, 2.6 square metres of cells of 25 mm. Beyond the capacity,
/// area not seen before stays unknown.
///
/// The newest evidence wins: what is seen free is no longer an obstacle, and the other way round.
class SeenMap {
 public:
  static constexpr std::int32_t kTileCells = 64;

  struct Tile {
    /// By mark, then by row from below; bit i is column i from the left. A cell has one mark at
    /// most.
    std::array<std::array<std::uint64_t, kTileCells>, kMarks> rows{};
    std::uint64_t noted = 0;  ///< in the map's log; no part of what was seen

    bool is(Mark mark, std::size_t row, std::size_t column) const {
      return (rows[static_cast<std::size_t>(mark)][row] >> column & 1) != 0;
    }
    /// Marks the cells of a row whose bits are set. True if that changed anything.
    bool mark_free(std::size_t row, std::uint64_t bits);
    /// Does nothing where an obstacle is known already and this one is suspected. True if it did.
    bool mark_obstacle(Mark mark, std::size_t row, std::size_t column);
  };
  using TileKey = map::TileKey;
  using IsGone = std::function<bool(const Vec2& place)>;  ///< empty: all are
  struct State {
    std::map<TileKey, Tile> tiles;
  };

  /// Cells of side `cell_m`, and at most `capacity` tiles.
  SeenMap(double cell_m, std::size_t capacity) : cell_m_(cell_m), capacity_(capacity) {}

  double cell_m() const { return cell_m_; }
  double tile_m() const { return cell_m_ * kTileCells; }

  /// Marks the cells that lie wholly within the sector as free; of those that are an obstacle, only
  /// where `is_gone(middle of the cell)` is true.
  void mark_free(const Sector& sector, const IsGone& is_gone = {});
  /// The same with cells of a row of one of the map's tiles; bit i is column i from the left.
  void mark_free(const TileKey& key, Tile& tile, std::size_t row, std::uint64_t bits,
                 const IsGone& is_gone);
  /// Marks the cell of a place as an obstacle, or as a suspected one.
  void mark_hit(const Vec2& place) { mark_obstacle(place, Mark::kHit); }
  /// Does nothing where an obstacle is known already.
  void mark_suspected(const Vec2& place) { mark_obstacle(place, Mark::kSuspected); }

  /// The tile, made if there is room; else null. It stays where it is as long as the map lives and
  /// its state is not replaced.
  Tile* tile_at(const TileKey& key);
  /// The tile, or null.
  const Tile* find_tile(const TileKey& key) const;

  /// Calls `visit(key, tile)` with the tiles from `first` to `last`, both included, column by
  /// column.
  template <typename Visit>
  void for_each_tile(const TileKey& first, const TileKey& last, Visit&& visit) const {
    for_each_tile_of(state_.tiles, first, last, visit);
  }
  template <typename Visit>
  void for_each_tile(const TileKey& first, const TileKey& last, Visit&& visit) {
    for_each_tile_of(state_.tiles, first, last, visit);
  }

  /// The least and the greatest column and row of the tiles within a distance of a place; nothing
  /// if there are none.
  struct Box {
    TileKey least;
    TileKey most;
  };
  std::optional<Box> box_within(const Vec2& place, double reach_m) const;

  /// Which tiles have changed. Marks of one round, such as a tick, are noted once.
  const TileLog& log() const { return log_; }
  void begin_round() { log_.begin_round(); }
  /// One of the map's tiles has got or lost a mark.
  void note(const TileKey& key, Tile& tile) { log_.note(key, tile.noted); }

  /// The column of an x, or the row of a y, counted from the origin.
  std::int64_t cell_number(double coordinate_m) const;
  /// Whether the cell of a place has a mark.
  bool is(Mark mark, const Vec2& place) const;

  /// Calls `visit(place)` with the middle of each cell of that mark within the rectangle, tile by
  /// tile.
  template <typename Visit>
  void for_each(Mark mark, const Vec2& least, const Vec2& most, Visit&& visit) const;

  /// Calls `is_it(place)` in that order until it is true, and tells whether it ever was.
  template <typename Predicate>
  bool find(Mark mark, const Vec2& least, const Vec2& most, Predicate&& is_it) const;

  /// The same, of the tiles for which `may_be_in(middle)` of the tile is true.
  template <typename TilePredicate, typename Predicate>
  bool find(Mark mark, const Vec2& least, const Vec2& most, TilePredicate&& may_be_in,
            Predicate&& is_it) const;

  /// From a place to the nearest point of a tile; 0 within it.
  double distance_m(const TileKey& key, const Vec2& place) const;

  const State& state() const { return state_; }
  /// What was seen is this.
  void restore(State state);

 private:
  struct Place {
    TileKey tile;
    std::size_t column = 0;
    std::size_t row = 0;
  };
  template <typename Tiles, typename Visit>
  static void for_each_tile_of(Tiles& tiles, const TileKey& first, const TileKey& last,
                               Visit&& visit);
  Place place_of(const Vec2& point) const;
  std::int32_t tile_number(double coordinate_m) const;
  template <typename Predicate>
  bool find_in(const TileKey& key, const Tile& tile, Mark mark, const Vec2& least, const Vec2& most,
               Predicate&& is_it) const;
  void mark_obstacle(const Vec2& place, Mark mark);

  double cell_m_;
  std::size_t capacity_;
  State state_;
  TileIndex index_;  // of its tiles
  TileLog log_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, SeenMap::Tile& t) {
  visit(t.rows);
}
template <typename Visitor>
void visit_fields(Visitor& visit, SeenMap::State& s) {
  visit(s.tiles);
}

/// Whether no cell has two marks: states come from files, too.
bool is_valid(const SeenMap::State& state);

template <typename Tiles, typename Visit>
void SeenMap::for_each_tile_of(Tiles& tiles, const TileKey& first, const TileKey& last,
                               Visit&& visit) {
  for (auto at = tiles.lower_bound(first); at != tiles.end() && at->first <= last;) {
    const TileKey key = at->first;
    if (key.second < first.second) {
      at = tiles.lower_bound({key.first, first.second});
    } else if (key.second > last.second) {
      at = tiles.lower_bound({key.first + 1, first.second});
    } else {
      visit(key, at->second);
      ++at;
    }
  }
}

template <typename Visit>
void SeenMap::for_each(Mark mark, const Vec2& least, const Vec2& most, Visit&& visit) const {
  find(mark, least, most, [&](const Vec2& place) {
    visit(place);
    return false;
  });
}

template <typename Predicate>
bool SeenMap::find(Mark mark, const Vec2& least, const Vec2& most, Predicate&& is_it) const {
  return find(
      mark, least, most, [](const Vec2&) { return true; }, is_it);
}

template <typename TilePredicate, typename Predicate>
bool SeenMap::find(Mark mark, const Vec2& least, const Vec2& most, TilePredicate&& may_be_in,
                   Predicate&& is_it) const {
  const TileKey first(tile_number(least.x()) - 1, tile_number(least.y()) - 1);
  const TileKey last(tile_number(most.x()) + 1, tile_number(most.y()) + 1);
  auto at = state_.tiles.lower_bound(first);
  while (at != state_.tiles.end() && at->first.first <= last.first) {
    const auto& [key, tile] = *at;
    if (key.second < first.second) {
      at = state_.tiles.lower_bound({key.first, first.second});
    } else if (key.second > last.second) {
      at = state_.tiles.lower_bound({key.first + 1, first.second});
    } else {
      const Vec2 middle = tile_m() * Vec2(key.first + 0.5, key.second + 0.5);
      if (may_be_in(middle) && find_in(key, tile, mark, least, most, is_it)) return true;
      ++at;
    }
  }
  return false;
}

template <typename Predicate>
bool SeenMap::find_in(const TileKey& key, const Tile& tile, Mark mark, const Vec2& least,
                      const Vec2& most, Predicate&& is_it) const {
  const Vec2 corner(key.first * tile_m(), key.second * tile_m());
  const auto& rows = tile.rows[static_cast<std::size_t>(mark)];
  // A row more to each side: whether a place is inside is for its own coordinates to say.
  const auto row_at = [&](double y_m) {
    return std::clamp(std::floor((y_m - corner.y()) / cell_m_), -2.0, kTileCells + 2.0);
  };
  const auto first = static_cast<std::size_t>(std::max(0.0, row_at(least.y()) - 1.0));
  const auto end = static_cast<std::size_t>(
      std::clamp(row_at(most.y()) + 2.0, 0.0, static_cast<double>(kTileCells)));
  for (std::size_t row = first; row < end; ++row) {
    for (std::uint64_t bits = rows[row]; bits != 0; bits &= bits - 1) {
      const Vec2 place =
          corner + cell_m_ * Vec2(__builtin_ctzll(bits) + 0.5, static_cast<double>(row) + 0.5);
      if (place.x() < least.x() || place.y() < least.y() || place.x() > most.x() ||
          place.y() > most.y()) {
        continue;
      }
      if (is_it(place)) return true;
    }
  }
  return false;
}

}  // namespace clew::map
