// SPDX-License-Identifier: Apache-2.0
#include "map/plain_blocks.hpp"

#include <algorithm>

namespace clew::map {

void PlainBlocks::lay(const Grid& grid) {
  const Grid before = blocks_;
  blocks_ = {grid.corner, kSide * grid.cell_m, grid.columns / kSide, grid.rows / kSide};
  lay_out_anew(before, blocks_, std::uint8_t{0}, dear_, spare_);
  dear_around_.assign(blocks_.size(), 0);
  for (std::size_t i = 0; i < dear_.size(); ++i) {
    if (dear_[i] > 0) count_around(blocks_.cell(i), true);
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
