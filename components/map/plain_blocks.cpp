// SPDX-License-Identifier: Apache-2.0
#include "map/plain_blocks.hpp"

#include <algorithm>

namespace clew::map {

void PlainBlocks::lay(const Grid& grid) {
  const Grid before = blocks_;
  Grid blocks{grid.corner, kSide * grid.cell_m, grid.columns / kSide, grid.rows / kSide};
  if (grid.last_place != Grid::kNoRing) blocks = in_ring(before, blocks);
  if (shares_places(before, blocks)) {
    leave(blocks);
    blocks_ = blocks;
    for_each_run_left(blocks, before,
                      [&](const Cell& first, std::int32_t count) { come(first, count); });
    return;
  }
  blocks_ = blocks;
  lay_out_anew(before, blocks, std::uint8_t{0}, dear_, spare_);
  dear_around_.assign(blocks.size(), 0);
  for (std::int32_t row = 0; row < blocks.rows; ++row) {
    for (std::int32_t column = 0; column < blocks.columns; ++column) {
      if (dear_[blocks.index({column, row})] > 0) count_around({column, row}, true);
    }
  }
}

/// Clears the blocks that the new grid has not.
void PlainBlocks::leave(const Grid& blocks) {
  for_each_run_left(blocks_, blocks, [&](const Cell& first, std::int32_t count) {
    for (std::int32_t i = 0; i < count; ++i) {
      const Cell block{first.column + i, first.row};
      std::uint8_t& dear = dear_[blocks_.index(block)];
      if (dear > 0) count_around(block, false);
      dear = 0;
    }
  });
  for_each_run_left(blocks_, blocks, [&](const Cell& first, std::int32_t count) {
    fill_run(blocks_, first, count, std::uint8_t{0}, dear_around_);
  });
}

/// Counts what lies around blocks that have come, and are not dear themselves.
void PlainBlocks::come(const Cell& first, std::int32_t count) {
  for (std::int32_t i = 0; i < count; ++i) {
    unsigned dear = 0;
    for (std::int32_t near = 0; near < 9; ++near) {
      const Cell block{first.column + i + near % 3 - 1, first.row + near / 3 - 1};
      if (blocks_.contains(block) && dear_[blocks_.index(block)] > 0) ++dear;
    }
    dear_around_[blocks_.index({first.column + i, first.row})] = static_cast<std::uint8_t>(dear);
  }
}

void PlainBlocks::count(const Cell& cell, bool more) {
  const Cell block{cell.column / kSide, cell.row / kSide};
  std::uint8_t& dear = dear_[blocks_.index(block)];
  dear = static_cast<std::uint8_t>(more ? dear + 1 : dear - 1);
  if (dear == (more ? 1 : 0)) count_around(block, more);
}

void PlainBlocks::count_around(const Cell& block, bool more) {
  const std::int32_t last_column = std::min(block.column + 1, blocks_.columns - 1);
  const std::int32_t last_row = std::min(block.row + 1, blocks_.rows - 1);
  for (std::int32_t row = std::max(block.row - 1, 0); row <= last_row; ++row) {
    for (std::int32_t column = std::max(block.column - 1, 0); column <= last_column; ++column) {
      std::uint8_t& dear = dear_around_[blocks_.index({column, row})];
      dear = static_cast<std::uint8_t>(more ? dear + 1 : dear - 1);
    }
  }
}

}  // namespace clew::map
