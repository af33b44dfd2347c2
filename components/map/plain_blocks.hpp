// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "map/grid.hpp"

namespace clew::map {

/// Where in a grid nothing is dear: blocks of 8 by 8 cells, counted by how many of their cells cost
/// other than 1, so that a line over cells that all cost 1 need not look at each of them.
class PlainBlocks {
 public:
  static constexpr std::int32_t kSide = 8;  ///< in cells

  /// Lays the counts out for another grid, a whole number of blocks beside. Both have a whole
  /// number of blocks. Cells that only the new one has cost 1.
  void lay(const Grid& grid);
  /// A cell that cost 1 costs other than 1 now.
  void add(const Cell& cell) { count(cell, true); }
  /// The other way round.
  void remove(const Cell& cell) { count(cell, false); }

  /// Whether all cells within kSide columns and rows of this one, itself included, cost 1. Never
  /// before the first grid. The cell lies within the grid.
  bool is_plain_around(std::int32_t column, std::int32_t row) const {
    if (dear_around_.empty()) return false;
    return dear_around_[blocks_.index({column / kSide, row / kSide})] == 0;
  }

 private:
  void count(const Cell& cell, bool more);
  void count_around(const Cell& block, bool more);
  void leave(const Grid& blocks);
  void come(const Cell& first, std::int32_t count);

  Grid blocks_;
  std::vector<std::uint8_t> dear_;         // cells of a block that cost other than 1
  std::vector<std::uint8_t> dear_around_;  // of the block and its neighbours, how many have any
  std::vector<std::uint8_t> spare_;
};

}  // namespace clew::map
