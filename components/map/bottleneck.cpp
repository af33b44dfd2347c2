// SPDX-License-Identifier: Apache-2.0
#include "map/bottleneck.hpp"

#include <algorithm>

namespace clew::map {
namespace {

constexpr std::int32_t kWordCells = 64;

/// Spreads bits to both sides over those that are open (Kogge & Stone's prefixes).
std::uint64_t filled(std::uint64_t bits, std::uint64_t open) {
  std::uint64_t up = bits;
  std::uint64_t down = bits;
  std::uint64_t open_up = open;
  std::uint64_t open_down = open;
  for (int step = 1; step < kWordCells; step *= 2) {
    up |= open_up & (up << step);
    down |= open_down & (down >> step);
    open_up &= open_up << step;
    open_down &= open_down >> step;
  }
  return up | down;
}

/// The bits of a word and their neighbours, also from the words beside it.
std::uint64_t widened(const std::uint64_t* word) {
  return *word | *word << 1 | *word >> 1 | word[-1] >> (kWordCells - 1) |
         word[1] << (kWordCells - 1);
}

}  // namespace

Clearance Bottleneck::between(const Grid& grid, const std::vector<Clearance>& room,
                              const Cell& start, const std::vector<Cell>& targets) {
  begin(grid);
  const std::uint64_t start_bit = std::uint64_t{1} << start.column % kWordCells;
  for (const Clearance least :
       {Clearance::kOpen, Clearance::kNarrow, Clearance::kSuspected, Clearance::kTouching}) {
    open(room, least);
    // What a higher level has flooded is flooded at this one, too.
    for (const Cell& target : targets) {
      if (room[grid.index(target)] < least) continue;
      word(flooded_, target) |= std::uint64_t{1} << target.column % kWordCells;
    }
    flood();
    if ((word(flooded_, start) & start_bit) != 0) return least;
  }
  return Clearance::kNone;
}

void Bottleneck::begin(const Grid& grid) {
  grid_ = grid;
  words_ = static_cast<std::size_t>((grid.columns + kWordCells - 1) / kWordCells) + 2;
  open_.assign(words_ * static_cast<std::size_t>(grid.rows), 0);
  flooded_.assign(open_.size(), 0);
}

std::uint64_t& Bottleneck::word(std::vector<std::uint64_t>& bits, const Cell& cell) const {
  return bits[static_cast<std::size_t>(cell.row) * words_ + 1 +
              static_cast<std::size_t>(cell.column / kWordCells)];
}

void Bottleneck::open(const std::vector<Clearance>& room, Clearance least) {
  for (std::int32_t row = 0; row < grid_.rows; ++row) {
    const Clearance* cells = room.data() + grid_.index({0, row});
    for (std::int32_t first = 0; first < grid_.columns; first += kWordCells) {
      const std::int32_t count = std::min(kWordCells, grid_.columns - first);
      std::uint64_t bits = 0;
      for (std::int32_t i = 0; i < count; ++i) {
        bits |= static_cast<std::uint64_t>(cells[first + i] >= least) << i;
      }
      word(open_, {first, row}) = bits;
    }
  }
}

/// Sweeps up and down until nothing changes.
void Bottleneck::flood() {
  for (bool changed = true; changed;) {
    changed = false;
    for (std::int32_t row = 0; row < grid_.rows; ++row) {
      changed = flood_row(row, std::max(row - 1, 0)) || changed;
    }
    for (std::int32_t row = grid_.rows; row-- > 0;) {
      changed = flood_row(row, std::min(row + 1, grid_.rows - 1)) || changed;
    }
  }
}

/// Takes the flood over from the row `before`, and along the row to both its ends.
bool Bottleneck::flood_row(std::int32_t row, std::int32_t before) {
  const std::uint64_t* from = &word(flooded_, {0, before});
  const std::uint64_t* open = &word(open_, {0, row});
  std::uint64_t* to = &word(flooded_, {0, row});
  const std::size_t count = words_ - 2;
  bool changed = false;
  const auto flood_word = [&](std::size_t i) {
    const std::uint64_t bits = filled((widened(to + i) | widened(from + i)) & open[i], open[i]);
    changed = changed || bits != to[i];
    to[i] = bits;
  };
  for (std::size_t i = 0; i < count; ++i) flood_word(i);
  for (std::size_t i = count; i-- > 0;) flood_word(i);
  return changed;
}

}  // namespace clew::map
