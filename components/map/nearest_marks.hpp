// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "map/grid.hpp"
#include "map/seen_map.hpp"

namespace clew::map {

/// How near the marks of what was seen are to the middle of each cell of a grid, up to a reach.
///
/// What was seen changes near the robot only, so the distances are repaired: update() compares the
/// marks with those of the time before, tile by tile, and works on the cells within reach of a
/// mark that came or went: of the tiles that the map has noted, or of all if it does not know.
/// Where the grid has moved, these and what lies near the borders that moved. The result does not
/// depend on the time before: where a mark went, the nearest of those left is looked for again.
/// Cells have twice the side of the map's, and lie on its lines, so a mark is in the middle of a
/// cell's quarter.
class NearestMarks {
 public:
  static constexpr double kStep_m = 0.0025;  ///< in which distances are kept
  static constexpr std::uint8_t kFar = 255;  ///< nothing within reach

  /// What obstacles are told apart.
  enum Obstacle : std::uint8_t { kHit = 0, kSuspected = 1 };

  /// What is known of a cell.
  struct Surroundings {
    /// From the cell's middle to the nearest obstacle, in kStep_m, by Obstacle.
    std::array<std::uint8_t, 2> steps{kFar, kFar};
    std::uint8_t marked = 0;  ///< bit i: a hit in quarter i; bit 4 + i: a suspected one
    bool seen_free = false;   ///< its first quarter, which stands for all
  };

  static std::uint8_t steps_of(double distance_m);

  NearestMarks(double cell_m, double reach_m);

  /// Takes in what was seen, as far as it lies within the grid: the same or another map, and the
  /// same or another grid.
  void update(const Grid& grid, const SeenMap& seen);

  /// By Grid::index.
  const std::vector<Surroundings>& cells() const { return cells_; }
  /// Cells that the last update() has changed, some of them more than once. Those that only the
  /// new grid has are among them if they are not far from everything.
  const std::vector<std::size_t>& changed() const { return changed_; }

 private:
  using Tile = SeenMap::Tile;
  using TileKey = SeenMap::TileKey;
  struct Offset {
    std::int32_t columns = 0;
    std::int32_t rows = 0;
    std::uint8_t steps = 0;
  };
  /// A column and row that may lie outside the grid, by far.
  struct Position {
    std::int64_t column = 0;
    std::int64_t row = 0;
  };
  struct Quarter {
    Position cell;
    std::size_t number = 0;
  };

  /// Tiles from one column and row to another, all included.
  struct Tiles {
    TileKey least;
    TileKey most;

    bool holds_column(std::int32_t column) const {
      return column >= least.first && column <= most.first;
    }
    bool holds(const TileKey& key) const {
      return holds_column(key.first) && key.second >= least.second && key.second <= most.second;
    }
  };

  void measure_around();
  bool lay(const Grid& grid);
  void unmark_left();
  bool is_whole(const Grid& grid) const;
  Tiles tiles_of(const Grid& grid) const;
  void take_in_all(const SeenMap& seen, bool moved);
  void take_in_moved(const SeenMap& seen);
  void drop_tiles_beside(const Tiles& now);
  void take_in_tile(const TileKey& key, const Tile& tile, bool all);
  Position corner_of(const TileKey& key, const Grid& grid) const;
  bool overlaps(const TileKey& key) const;
  bool is_within(const TileKey& key, const Grid& grid, std::int64_t margin_cells) const;
  Tile clipped(const TileKey& key, const Tile& tile) const;
  void take_in(const TileKey& key, Tile& known, const Tile& now, bool all);
  void take_in_free(const Position& corner, const Tile& known, const Tile& now);
  void come(Obstacle obstacle, const Quarter& place);
  void go(Obstacle obstacle, const Quarter& place);
  void look_around(std::size_t index);
  void note_marked(const Surroundings& cell);
  Surroundings* at(const Position& cell);

  double cell_m_;
  double reach_m_;
  std::int32_t reach_cells_;
  std::array<std::vector<Offset>, 4> around_;       // of the quarters of a cell
  std::array<std::vector<std::uint8_t>, 4> steps_;  // the same by column and row, from the least
  Grid grid_;
  Grid before_;                    // the grid of the last update
  std::map<TileKey, Tile> known_;  // the marks that are taken in
  std::vector<Surroundings> cells_;
  std::vector<Surroundings> spare_;
  std::vector<std::uint64_t>
      marked_;  // 64 cells each, by Grid::index: a bit is set if it is marked
  std::vector<std::size_t> changed_;
  std::vector<std::size_t> bared_;  // cells whose nearest mark went
  TileLog::Position read_;          // of the map's log
  std::vector<TileKey> news_;       // tiles that have changed
};

}  // namespace clew::map
