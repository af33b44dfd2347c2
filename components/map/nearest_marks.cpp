// SPDX-License-Identifier: Apache-2.0
#include "map/nearest_marks.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace clew::map {
namespace {

constexpr std::int64_t kTileCells = SeenMap::kTileCells / 2;  // of the grid, along a tile's side
constexpr std::array<Mark, 2> kMarkOf = {Mark::kHit, Mark::kSuspected};  // by Obstacle
constexpr std::uint64_t kEvenColumns = 0x5555555555555555;

bool same(const SeenMap::Tile& a, const SeenMap::Tile& b) {
  return std::memcmp(a.rows.data(), b.rows.data(), sizeof(a.rows)) == 0;
}

/// The columns of a tile's row from `first` to before `end`, which are cells of the grid.
std::uint64_t columns_between(std::int64_t first, std::int64_t end) {
  if (first >= end) return 0;
  return ~std::uint64_t{0} >> (64 - 2 * (end - first)) << (2 * first);
}

}  // namespace

std::uint8_t NearestMarks::steps_of(double distance_m) {
  return static_cast<std::uint8_t>(std::min(255.0, std::floor(distance_m / kStep_m + 0.5)));
}

NearestMarks::NearestMarks(double cell_m, double reach_m)
    : cell_m_(cell_m),
      reach_m_(reach_m),
      reach_cells_(static_cast<std::int32_t>(std::ceil(reach_m / cell_m)) + 1) {
  measure_around();
}

void NearestMarks::measure_around() {
  for (std::size_t quarter = 0; quarter < around_.size(); ++quarter) {
    const Vec2 place(quarter % 2 == 0 ? 0.25 : 0.75, quarter < 2 ? 0.25 : 0.75);
    for (std::int32_t rows = -reach_cells_; rows <= reach_cells_; ++rows) {
      for (std::int32_t columns = -reach_cells_; columns <= reach_cells_; ++columns) {
        const double distance_m = cell_m_ * core::length(Vec2(columns + 0.5, rows + 0.5) - place);
        const std::uint8_t steps = distance_m > reach_m_ ? kFar : steps_of(distance_m);
        steps_[quarter].push_back(steps);
        if (steps < kFar) around_[quarter].push_back({columns, rows, steps});
      }
    }
  }
}

void NearestMarks::update(const Grid& grid, const SeenMap& seen) {
  changed_.clear();
  bared_.clear();
  const bool moved = lay(grid);
  if (!seen.log().read(read_, news_) || (moved && !(is_whole(before_) && is_whole(grid_)))) {
    take_in_all(seen, moved);
  } else {
    if (moved) take_in_moved(seen);
    for (const TileKey& key : news_) {
      const Tile* tile = overlaps(key) ? seen.find_tile(key) : nullptr;
      if (tile != nullptr) take_in_tile(key, *tile, false);
    }
  }
  for (const std::size_t index : bared_) look_around(index);
}

/// Compares all tiles.
void NearestMarks::take_in_all(const SeenMap& seen, bool moved) {
  const auto& tiles = seen.state().tiles;
  for (auto known = known_.begin(); known != known_.end();) {
    const bool left = overlaps(known->first) && tiles.count(known->first) != 0;
    if (!left) take_in(known->first, known->second, {}, false);
    known = left ? std::next(known) : known_.erase(known);
  }
  for (const auto& [key, tile] : tiles) {
    // Around marks near a border of the grid of before, cells may have come.
    if (overlaps(key)) take_in_tile(key, tile, moved && !is_within(key, before_, reach_cells_));
  }
}

void NearestMarks::take_in_tile(const TileKey& key, const Tile& tile, bool all) {
  Tile& known = known_[key];
  if (is_within(key, grid_, 0)) {
    take_in(key, known, tile, all);
  } else {
    take_in(key, known, clipped(key, tile), all);
  }
}

/// Takes in the tiles that lie within the grid now and did not before, and those near enough to the
/// borders that moved that cells beyond may be near to their marks.
void NearestMarks::take_in_moved(const SeenMap& seen) {
  const Tiles now = tiles_of(grid_);
  drop_tiles_beside(now);
  Tiles same = tiles_of(before_);
  const auto near = static_cast<std::int32_t>((reach_cells_ + kTileCells - 1) / kTileCells);
  if (now.least.first < same.least.first) same.least.first += near;
  if (now.least.second < same.least.second) same.least.second += near;
  if (now.most.first > same.most.first) same.most.first -= near;
  if (now.most.second > same.most.second) same.most.second -= near;
  const auto take = [&](const TileKey& key, const Tile& tile) { take_in_tile(key, tile, true); };
  for (std::int32_t column = now.least.first; column <= now.most.first; ++column) {
    const TileKey first{column, now.least.second};
    const TileKey last{column, now.most.second};
    if (same.holds_column(column) && same.least.second <= same.most.second) {
      seen.for_each_tile(first, {column, std::min(last.second, same.least.second - 1)}, take);
      seen.for_each_tile({column, std::max(first.second, same.most.second + 1)}, last, take);
    } else {
      seen.for_each_tile(first, last, take);
    }
  }
}

/// Forgets the tiles that lie within the grid no more.
void NearestMarks::drop_tiles_beside(const Tiles& now) {
  for (auto known = known_.begin(); known != known_.end();) {
    if (now.holds(known->first)) {
      known = known_.upper_bound({known->first.first, now.most.second});
    } else {
      take_in(known->first, known->second, {}, false);
      known = known_.erase(known);
    }
  }
}

/// Whether its borders are those of tiles.
bool NearestMarks::is_whole(const Grid& grid) const {
  const Position corner = corner_of({0, 0}, grid);
  return grid.columns > 0 && corner.column % kTileCells == 0 && corner.row % kTileCells == 0 &&
         grid.columns % kTileCells == 0 && grid.rows % kTileCells == 0;
}

/// Of a whole grid.
NearestMarks::Tiles NearestMarks::tiles_of(const Grid& grid) const {
  const Position corner = corner_of({0, 0}, grid);
  const auto column = static_cast<std::int32_t>(-corner.column / kTileCells);
  const auto row = static_cast<std::int32_t>(-corner.row / kTileCells);
  constexpr auto kCells = static_cast<std::int32_t>(kTileCells);
  return {{column, row}, {column + grid.columns / kCells - 1, row + grid.rows / kCells - 1}};
}

/// True if the grid is another one than before.
bool NearestMarks::lay(const Grid& grid) {
  before_ = grid_;
  if (grid == before_) return false;
  grid_ = grid;
  const bool stays = shares_places(before_, grid);
  if (stays) unmark_left();
  lay_out_anew(before_, grid, Surroundings{}, cells_, spare_);
  if (stays) return true;
  marked_.assign((grid.size() + 63) / 64, 0);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (cells_[i].marked != 0) marked_[i / 64] |= std::uint64_t{1} << i % 64;
  }
  return true;
}

/// Cells that the grid has no more are not marked.
void NearestMarks::unmark_left() {
  for_each_run_left(before_, grid_, [&](const Cell& cell, std::int32_t count) {
    for (std::int32_t i = 0; i < count; ++i) {
      const std::size_t place = before_.index({cell.column + i, cell.row});
      marked_[place / 64] &= ~(std::uint64_t{1} << place % 64);
    }
  });
}

/// The cell of a grid at a tile's corner of least x and y.
NearestMarks::Position NearestMarks::corner_of(const TileKey& key, const Grid& grid) const {
  return {key.first * kTileCells - std::llround(grid.corner.x() / cell_m_),
          key.second * kTileCells - std::llround(grid.corner.y() / cell_m_)};
}

bool NearestMarks::overlaps(const TileKey& key) const {
  const Position corner = corner_of(key, grid_);
  return corner.column + kTileCells > 0 && corner.column < grid_.columns &&
         corner.row + kTileCells > 0 && corner.row < grid_.rows;
}

/// Whether a tile and so much around it lies within a grid.
bool NearestMarks::is_within(const TileKey& key, const Grid& grid,
                             std::int64_t margin_cells) const {
  const Position corner = corner_of(key, grid);
  return corner.column >= margin_cells && corner.row >= margin_cells &&
         corner.column + kTileCells + margin_cells <= grid.columns &&
         corner.row + kTileCells + margin_cells <= grid.rows;
}

/// What of a tile lies within the grid.
NearestMarks::Tile NearestMarks::clipped(const TileKey& key, const Tile& tile) const {
  const Position corner = corner_of(key, grid_);
  const std::uint64_t columns =
      columns_between(std::max<std::int64_t>(0, -corner.column),
                      std::min<std::int64_t>(kTileCells, grid_.columns - corner.column));
  Tile part;
  for (std::int64_t row = 0; row < SeenMap::kTileCells; ++row) {
    const std::int64_t cell_row = corner.row + row / 2;
    if (cell_row < 0 || cell_row >= grid_.rows) continue;
    const auto r = static_cast<std::size_t>(row);
    for (std::size_t mark = 0; mark < kMarks; ++mark) {
      part.rows[mark][r] = tile.rows[mark][r] & columns;
    }
  }
  return part;
}

/// Repairs around the marks that came or went; around all of them where all may be news.
void NearestMarks::take_in(const TileKey& key, Tile& known, const Tile& now, bool all) {
  if (!all && same(known, now)) return;
  const Position corner = corner_of(key, grid_);
  for (const Obstacle obstacle : {kHit, kSuspected}) {
    const auto mark = static_cast<std::size_t>(kMarkOf[obstacle]);
    for (std::size_t row = 0; row < known.rows[mark].size(); ++row) {
      const std::uint64_t old = known.rows[mark][row];
      const std::uint64_t fresh = now.rows[mark][row];
      const auto quarter = [&](std::uint64_t bits) -> Quarter {
        const auto column = static_cast<std::size_t>(__builtin_ctzll(bits));
        return {{corner.column + static_cast<std::int64_t>(column / 2),
                 corner.row + static_cast<std::int64_t>(row / 2)},
                column % 2 + 2 * (row % 2)};
      };
      for (std::uint64_t bits = old & ~fresh; bits != 0; bits &= bits - 1) {
        go(obstacle, quarter(bits));
      }
      for (std::uint64_t bits = all ? fresh : fresh & ~old; bits != 0; bits &= bits - 1) {
        come(obstacle, quarter(bits));
      }
    }
  }
  take_in_free(corner, known, now);
  known = now;
}

void NearestMarks::take_in_free(const Position& corner, const Tile& known, const Tile& now) {
  const auto mark = static_cast<std::size_t>(Mark::kFree);
  for (std::size_t row = 0; row < known.rows[mark].size(); row += 2) {
    std::uint64_t bits = (known.rows[mark][row] ^ now.rows[mark][row]) & kEvenColumns;
    for (; bits != 0; bits &= bits - 1) {
      const int column = __builtin_ctzll(bits);
      Surroundings* cell =
          at({corner.column + column / 2, corner.row + static_cast<std::int64_t>(row / 2)});
      if (cell == nullptr) continue;
      cell->seen_free = (now.rows[mark][row] >> column & 1) != 0;
      changed_.push_back(static_cast<std::size_t>(cell - cells_.data()));
    }
  }
}

/// A mark is there.
void NearestMarks::come(Obstacle obstacle, const Quarter& place) {
  Surroundings* own = at(place.cell);
  if (own != nullptr) {
    own->marked = static_cast<std::uint8_t>(own->marked | 1U << (4U * obstacle + place.number));
    note_marked(*own);
  }
  for (const Offset& offset : around_[place.number]) {
    Surroundings* cell = at({place.cell.column + offset.columns, place.cell.row + offset.rows});
    if (cell == nullptr || cell->steps[obstacle] <= offset.steps) continue;
    cell->steps[obstacle] = offset.steps;
    changed_.push_back(static_cast<std::size_t>(cell - cells_.data()));
  }
}

/// A mark is there no longer: cells that are nearer to another one keep that.
void NearestMarks::go(Obstacle obstacle, const Quarter& place) {
  Surroundings* own = at(place.cell);
  if (own != nullptr) {
    own->marked = static_cast<std::uint8_t>(own->marked & ~(1U << (4U * obstacle + place.number)));
    note_marked(*own);
  }
  for (const Offset& offset : around_[place.number]) {
    Surroundings* cell = at({place.cell.column + offset.columns, place.cell.row + offset.rows});
    if (cell == nullptr || cell->steps[obstacle] != offset.steps) continue;
    cell->steps[obstacle] = kFar;
    bared_.push_back(static_cast<std::size_t>(cell - cells_.data()));
  }
}

/// Keeps whether a cell of the grid is marked.
void NearestMarks::note_marked(const Surroundings& cell) {
  const auto place = static_cast<std::size_t>(&cell - cells_.data());
  const std::uint64_t bit = std::uint64_t{1} << place % 64;
  std::uint64_t& word = marked_[place / 64];
  word = cell.marked != 0 ? word | bit : word & ~bit;
}

/// Finds the marks that are nearest to a cell.
void NearestMarks::look_around(std::size_t index) {
  const Cell cell = grid_.cell(index);
  std::array<std::uint8_t, 2> nearest = {kFar, kFar};
  const std::int32_t side = 2 * reach_cells_ + 1;
  const std::int32_t first = std::max(0, cell.column - reach_cells_);
  const std::int32_t last = std::min(grid_.columns - 1, cell.column + reach_cells_);
  const std::int32_t last_row = std::min(grid_.rows - 1, cell.row + reach_cells_);
  for (std::int32_t row = std::max(0, cell.row - reach_cells_); row <= last_row; ++row) {
    // Seen from the mark, the cell lies on the other side.
    const std::int32_t rows = (cell.row - row + reach_cells_) * side;
    for (std::int32_t column = first; column <= last;) {
      const std::size_t place = grid_.index({column, row});
      const std::int32_t count =
          std::min(64 - static_cast<std::int32_t>(place % 64), last - column + 1);
      std::uint64_t bits = marked_[place / 64] >> place % 64 & ~std::uint64_t{0} >> (64 - count);
      for (; bits != 0; bits &= bits - 1) {
        const auto i = static_cast<std::int32_t>(__builtin_ctzll(bits));
        const auto offset =
            static_cast<std::size_t>(rows + cell.column - column - i + reach_cells_);
        std::uint32_t marked = cells_[place + static_cast<std::size_t>(i)].marked;
        for (; marked != 0; marked &= marked - 1) {
          const auto bit = static_cast<std::size_t>(__builtin_ctz(marked));
          nearest[bit / 4] = std::min(nearest[bit / 4], steps_[bit % 4][offset]);
        }
      }
      column += count;
    }
  }
  cells_[index].steps = nearest;
  changed_.push_back(index);
}

/// Null outside the grid.
NearestMarks::Surroundings* NearestMarks::at(const Position& cell) {
  const bool inside =
      cell.column >= 0 && cell.row >= 0 && cell.column < grid_.columns && cell.row < grid_.rows;
  if (!inside) return nullptr;
  return &cells_[grid_.index(
      {static_cast<std::int32_t>(cell.column), static_cast<std::int32_t>(cell.row)})];
}

}  // namespace clew::map
