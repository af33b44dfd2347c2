// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "map/block_steps.hpp"
#include "map/distance_field.hpp"

namespace clew::map {

/// Lays what is known out for another grid. Blocks that only this one has are free as yet: most
/// of a grid was never seen, and so the work is that of what was. False if nothing was kept, so
/// that all are free.
bool DistanceField::lay(const Grid& grid) {
  const Grid before = blocks_;
  const Vec2 shift = (grid.corner - grid_.corner) / grid.cell_m;
  const Cell cells = shift_between(grid_, grid);
  // A goal beside one of the grids has left no mark there: all is made anew.
  const auto is_kept = [&](const Cell& goal) {
    return grid_.contains(goal) &&
           grid.contains({goal.column - cells.column, goal.row - cells.row});
  };
  const bool lies_on = !nodes_.empty() && grid.cell_m == grid_.cell_m && cells.column % 2 == 0 &&
                       cells.row % 2 == 0 && shift.cwiseAbs().maxCoeff() < 1e9 &&
                       std::all_of(goals_.begin(), goals_.end(), is_kept);
  grid_ = grid;
  const double block_m = 2.0 * grid.cell_m;
  blocks_ = in_ring(before, {grid.corner - Vec2(block_m, block_m), block_m,
                             (grid.columns + 1) / 2 + 2, (grid.rows + 1) / 2 + 2});
  last_place_ = static_cast<std::uint32_t>(blocks_.last_place);
  for (std::size_t i = 0; i < kSteps; ++i) {
    offsets_[i] = static_cast<std::uint32_t>(
        kBlockSteps[i].rows * static_cast<std::int32_t>(blocks_.stride()) + kBlockSteps[i].columns);
  }
  is_touched_.resize(blocks_.size(), 0);
  if (lies_on) {
    keep_laid_out(before);
  } else {
    nodes_.assign(blocks_.size(), free_node());
    goals_.clear();
    clear();
    close_border({{1, 1}, {0, 0}});
  }
  return lies_on;
}

/// A block that costs 1 and of which every step leads somewhere.
DistanceField::Node DistanceField::free_node() {
  Node node;
  node.weight = kWeightOfOne;
  node.members = kAllMembers;
  node.open = 0xFF;
  return node;
}

/// Leaves blocks where they are, or moves them to where they lie now.
void DistanceField::keep_laid_out(const Grid& before) {
  const bool stays = shares_places(before, blocks_);
  lay_out_anew(before, blocks_, free_node(), nodes_, spare_);
  const Cell shift = shift_between(before, blocks_);
  for (Cell& goal : goals_) goal = {goal.column - 2 * shift.column, goal.row - 2 * shift.row};
  start_ = {start_.column - shift.column, start_.row - shift.row};
  const Outline outline{{-shift.column, -shift.row},
                        {before.columns - 1 - shift.column, before.rows - 1 - shift.row}};
  open_border(outline);
  close_border(outline);
  if (!stays) queue_anew();
}

/// The buckets' numbers are others now: all blocks that wait are put into them anew.
void DistanceField::queue_anew() {
  queue_.clear();
  for (std::int32_t row = 0; row < blocks_.rows; ++row) {
    for (std::int32_t column = 0; column < blocks_.columns; ++column) {
      const Cell block{column, row};
      Node& node = nodes_[at(block)];
      node.queued = kNotQueued;
      if (node.look_ahead == kVoid) {
        queue_with(estimate(start_, block) + moved_, at(block));  // before all others
      } else {
        queue(at(block), block);
      }
    }
  }
}

/// Calls `visit(block)` with the outermost blocks of a rectangle.
template <typename Visit>
void for_each_outermost(const Cell& least, const Cell& most, Visit&& visit) {
  for (std::int32_t column = least.column; column <= most.column; ++column) {
    visit(Cell{column, least.row});
    visit(Cell{column, most.row});
  }
  for (std::int32_t row = least.row; row <= most.row; ++row) {
    visit(Cell{least.column, row});
    visit(Cell{most.column, row});
  }
}

/// Blocks the border, and takes the blocks beside it for changed where they did not lie beside that
/// of before: their steps lead there no more.
void DistanceField::close_border(const Outline& before) {
  const Cell most{blocks_.columns - 1, blocks_.rows - 1};
  for_each_outermost({0, 0}, most, [&](const Cell& block) { nodes_[at(block)] = {}; });
  const auto within = [&](const Cell& block) {
    return block.column > before.least.column && block.column < before.most.column &&
           block.row > before.least.row && block.row < before.most.row;
  };
  // Of a block beside the border, whether it led no farther to that side before.
  const auto was_beside = [&](const Cell& block) {
    if (!within(block)) return false;
    return (block.column != 1 || before.least.column == 0) &&
           (block.column != most.column - 1 || before.most.column == most.column) &&
           (block.row != 1 || before.least.row == 0) &&
           (block.row != most.row - 1 || before.most.row == most.row);
  };
  for_each_outermost({1, 1}, {most.column - 1, most.row - 1}, [&](const Cell& block) {
    if (!was_beside(block)) note(block);
  });
}

/// Takes a block for changed, if it is within the border.
void DistanceField::note(const Cell& block) {
  const bool inside = block.column > 0 && block.row > 0 && block.column < blocks_.columns - 1 &&
                      block.row < blocks_.rows - 1;
  if (inside) changed_.push_back(at(block));
}

/// Frees the blocks of the border of before. Those beside them may now lead there.
void DistanceField::open_border(const Outline& before) {
  const auto first = changed_.size();
  for_each_outermost(before.least, before.most, [&](const Cell& block) { note(block); });
  for (std::size_t i = first; i < changed_.size(); ++i) nodes_[changed_[i]] = free_node();
}

}  // namespace clew::map
