// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "map/block_steps.hpp"
#include "map/distance_field.hpp"

namespace clew::map {

/// Lays what is known out for another grid. Blocks that only this one has are free as yet: most
/// of a grid was never seen, and so the work is that of what was.
void DistanceField::lay(const Grid& grid) {
  const Grid before = blocks_;
  const Vec2 shift = (grid.corner - grid_.corner) / grid.cell_m;
  const auto right = static_cast<std::int32_t>(std::llround(shift.x()));
  const auto up = static_cast<std::int32_t>(std::llround(shift.y()));
  // A goal beside one of the grids has left no mark there: all is made anew.
  const auto is_kept = [&](const Cell& goal) {
    return grid_.contains(goal) && grid.contains({goal.column - right, goal.row - up});
  };
  const bool lies_on = grid.cell_m == grid_.cell_m && right % 2 == 0 && up % 2 == 0 &&
                       std::all_of(goals_.begin(), goals_.end(), is_kept);
  grid_ = grid;
  blocks_.cell_m = 2.0 * grid.cell_m;
  blocks_.corner = grid.corner - Vec2(blocks_.cell_m, blocks_.cell_m);
  blocks_.columns = (grid.columns + 1) / 2 + 2;
  blocks_.rows = (grid.rows + 1) / 2 + 2;
  for (std::size_t i = 0; i < kSteps; ++i) {
    offsets_[i] =
        static_cast<std::uint32_t>(kBlockSteps[i].rows * blocks_.columns + kBlockSteps[i].columns);
  }
  is_touched_.assign(blocks_.size(), 0);
  if (lies_on && !nodes_.empty()) {
    keep_laid_out(before);
  } else {
    nodes_.assign(blocks_.size(), free_node());
    goals_.clear();
    clear();
  }
  close_border();
}

/// A block that costs 1 and of which every step leads somewhere.
DistanceField::Node DistanceField::free_node() {
  Node node;
  node.weight = kWeightOfOne;
  node.members = kAllMembers;
  node.open = 0xFF;
  return node;
}

/// Blocks the border, and takes the blocks beside it for changed: their steps lead there no more.
void DistanceField::close_border() {
  const std::int32_t right = blocks_.columns - 1;
  const std::int32_t top = blocks_.rows - 1;
  const auto close = [&](const Cell& block) { nodes_[at(block)] = {}; };
  for (std::int32_t column = 0; column <= right; ++column) {
    close({column, 0});
    close({column, top});
  }
  for (std::int32_t row = 1; row < top; ++row) {
    close({0, row});
    close({right, row});
  }
  note_outline({1, 1}, {right - 1, top - 1});
}

/// Takes the outermost blocks of a rectangle for changed, as far as they are within the border.
void DistanceField::note_outline(const Cell& least, const Cell& most) {
  const auto note = [&](const Cell& block) {
    const bool inside = block.column > 0 && block.row > 0 && block.column < blocks_.columns - 1 &&
                        block.row < blocks_.rows - 1;
    if (inside) changed_.push_back(at(block));
  };
  for (std::int32_t column = least.column; column <= most.column; ++column) {
    note({column, least.row});
    note({column, most.row});
  }
  for (std::int32_t row = least.row; row <= most.row; ++row) {
    note({least.column, row});
    note({most.column, row});
  }
}

/// Moves blocks to where they lie now.
void DistanceField::keep_laid_out(const Grid& before) {
  lay_out_anew(before, blocks_, free_node(), nodes_, spare_);
  const Vec2 shift = (blocks_.corner - before.corner) / blocks_.cell_m;
  const auto right = static_cast<std::int32_t>(std::llround(shift.x()));
  const auto up = static_cast<std::int32_t>(std::llround(shift.y()));
  for (Cell& goal : goals_) goal = {goal.column - 2 * right, goal.row - 2 * up};
  start_ = {start_.column - right, start_.row - up};
  open_outline({-right, -up}, {before.columns - 1 - right, before.rows - 1 - up});
  queue_.clear();
  for (std::uint32_t place = 0; place < nodes_.size(); ++place) {
    Node& node = nodes_[place];
    node.queued = kNotQueued;
    const Cell block = block_at(place);
    if (node.look_ahead == kVoid) {
      queue_with(estimate(start_, block) + moved_, place);  // before all others
    } else {
      queue(place, block);
    }
  }
}

/// Frees the blocks of the border of before. Those beside them may now lead there.
void DistanceField::open_outline(const Cell& least, const Cell& most) {
  const auto first = changed_.size();
  note_outline(least, most);
  for (std::size_t i = first; i < changed_.size(); ++i) nodes_[changed_[i]] = free_node();
}

}  // namespace clew::map
