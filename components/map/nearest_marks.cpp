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

/// How many words hold a bit for each column.
std::size_t words_of(const Grid& grid) {
  return (static_cast<std::size_t>(grid.columns) + 63) / 64;
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
  const auto& tiles = seen.state().tiles;
  for (auto known = known_.begin(); known != known_.end();) {
    const bool left = overlaps(known->first) && tiles.count(known->first) != 0;
    if (!left) take_in(known->first, known->second, {}, false);
    known = left ? std::next(known) : known_.erase(known);
  }
  auto known = known_.begin();
  for (const auto& [key, tile] : tiles) {
    if (!overlaps(key)) continue;
    while (known != known_.end() && known->first < key) ++known;
    known = known_.try_emplace(known, key);
    // Around marks near a border of the grid of before, cells may have come.
    const bool all = moved && !is_within(key, before_, reach_cells_);
    if (is_within(key, grid_, 0)) {
      take_in(key, known->second, tile, all);
    } else {
      take_in(key, known->second, clipped(key, tile), all);
    }
  }
  for (const std::size_t index : bared_) look_around(index);
}

/// True if the grid is another one than before.
bool NearestMarks::lay(const Grid& grid) {
  before_ = grid_;
  if (grid == before_) return false;
  grid_ = grid;
  lay_out_anew(before_, grid, Surroundings{}, cells_, spare_);
  marked_.assign(words_of(grid) * static_cast<std::size_t>(grid.rows), 0);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (cells_[i].marked == 0) continue;
    const Cell cell = grid.cell(i);
    note_marked({cell.column, cell.row}, cells_[i]);
  }
  return true;
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
    note_marked(place.cell, *own);
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
    note_marked(place.cell, *own);
  }
  for (const Offset& offset : around_[place.number]) {
    Surroundings* cell = at({place.cell.column + offset.columns, place.cell.row + offset.rows});
    if (cell == nullptr || cell->steps[obstacle] != offset.steps) continue;
    cell->steps[obstacle] = kFar;
    bared_.push_back(static_cast<std::size_t>(cell - cells_.data()));
  }
}

/// Keeps whether a cell of the grid is marked.
void NearestMarks::note_marked(const Position& cell, const Surroundings& surroundings) {
  const auto column = static_cast<std::size_t>(cell.column);
  std::uint64_t& word = marked_[static_cast<std::size_t>(cell.row) * words_of(grid_) + column / 64];
  const std::uint64_t bit = std::uint64_t{1} << column % 64;
  word = surroundings.marked != 0 ? word | bit : word & ~bit;
}

/// Finds the marks that are nearest to a cell.
void NearestMarks::look_around(std::size_t index) {
  const Cell cell = grid_.cell(index);
  std::array<std::uint8_t, 2> nearest = {kFar, kFar};
  const std::int32_t side = 2 * reach_cells_ + 1;
  const auto first = static_cast<std::uint32_t>(std::max(0, cell.column - reach_cells_));
  const auto last =
      static_cast<std::uint32_t>(std::min(grid_.columns - 1, cell.column + reach_cells_));
  const std::int32_t last_row = std::min(grid_.rows - 1, cell.row + reach_cells_);
  for (std::int32_t row = std::max(0, cell.row - reach_cells_); row <= last_row; ++row) {
    // Seen from the mark, the cell lies on the other side.
    const std::int32_t rows = (cell.row - row + reach_cells_) * side;
    const std::uint64_t* words = &marked_[static_cast<std::size_t>(row) * words_of(grid_)];
    const Surroundings* cells = &cells_[grid_.index({0, row})];
    for (std::uint32_t word = first / 64; word <= last / 64; ++word) {
      std::uint64_t bits = words[word];
      if (word == first / 64) bits &= ~std::uint64_t{0} << first % 64;
      if (word == last / 64) bits &= ~std::uint64_t{0} >> (63 - last % 64);
      for (; bits != 0; bits &= bits - 1) {
        const auto column =
            static_cast<std::int32_t>(64 * word) + static_cast<std::int32_t>(__builtin_ctzll(bits));
        const auto offset = static_cast<std::size_t>(rows + cell.column - column + reach_cells_);
        for (std::uint32_t marked = cells[column].marked; marked != 0; marked &= marked - 1) {
          const auto bit = static_cast<std::size_t>(__builtin_ctz(marked));
          nearest[bit / 4] = std::min(nearest[bit / 4], steps_[bit % 4][offset]);
        }
      }
    }
  }
  cells_[index].steps = nearest;
  changed_.push_back(index);
}

/// Null outside the grid.
NearestMarks::Surroundings* NearestMarks::at(const Position& cell) {
  const bool inside =
      cell.column >= 0 && cell.row >= 0 && cell.column < grid_.columns && cell.row < grid_.rows;
  return inside ? &cells_[static_cast<std::size_t>(cell.row * grid_.columns + cell.column)]
                : nullptr;
}

}  // namespace clew::map
