// SPDX-License-Identifier: Apache-2.0
#include "map/astar.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace clew::map {
namespace {

struct Step {
  std::int32_t columns;
  std::int32_t rows;
  float length;  // in cells
};
constexpr float kDiagonal = 1.41421356F;
constexpr std::array<Step, 8> kSteps = {{{1, 0, 1.0F},
                                         {0, 1, 1.0F},
                                         {-1, 0, 1.0F},
                                         {0, -1, 1.0F},
                                         {1, 1, kDiagonal},
                                         {-1, 1, kDiagonal},
                                         {-1, -1, kDiagonal},
                                         {1, -1, kDiagonal}}};

}  // namespace

void AStar::begin(const Costmap& costs) {
  ++search_;
  if (nodes_.size() < costs.cost.size()) nodes_.resize(costs.cost.size());
  open_.clear();
  way_.clear();
}

/// Whether a way here of that cost is better than all before.
bool AStar::is_better(std::uint32_t cell, float cost_m) const {
  const Node& node = nodes_[cell];
  return node.search != search_ || !(node.closed || node.cost_m <= cost_m);
}

void AStar::open(std::uint32_t cell, std::uint32_t before, float cost_m, float estimate_m) {
  nodes_[cell] = {cost_m, before, search_, false};
  open_.push_back({estimate_m, cell});
  std::push_heap(open_.begin(), open_.end(), IsLater{});
}

const std::vector<Vec2>& AStar::find(const Costmap& costs, const Vec2& from, const Vec2& to,
                                     double goal_radius_m) {
  begin(costs);
  const Grid& grid = costs.grid;
  const auto start = grid.cell_at(from);
  if (!start || costs.cost[grid.index(*start)] == Costmap::kBlocked) return way_;
  const auto cell_m = static_cast<float>(grid.cell_m);
  // Distances in cells, from the target's place.
  const Vec2 goal = (to - grid.corner) / grid.cell_m - Vec2(0.5, 0.5);
  const auto goal_x = static_cast<float>(goal.x());
  const auto goal_y = static_cast<float>(goal.y());
  const auto radius_m = static_cast<float>(goal_radius_m);
  const auto still_m = [&](const Cell& cell) {
    const float x = static_cast<float>(cell.column) - goal_x;
    const float y = static_cast<float>(cell.row) - goal_y;
    return std::max(0.0F, cell_m * std::sqrt(x * x + y * y) - radius_m);
  };
  const auto first = static_cast<std::uint32_t>(grid.index(*start));
  open(first, first, 0.0F, still_m(*start));
  std::array<float, kSteps.size()> share_m;  // of a step's length for each of its cells
  for (std::size_t i = 0; i < kSteps.size(); ++i) share_m[i] = 0.5F * cell_m * kSteps[i].length;
  while (!open_.empty()) {
    const std::uint32_t here = open_.front().cell;
    std::pop_heap(open_.begin(), open_.end(), IsLater{});
    open_.pop_back();
    Node& node = nodes_[here];
    if (node.closed) continue;
    node.closed = true;
    const Cell cell = grid.cell(here);
    if (still_m(cell) <= 0.0F) {
      trace(grid, here);
      break;
    }
    const float cost_m = node.cost_m;
    for (std::size_t i = 0; i < kSteps.size(); ++i) {
      const Cell next{cell.column + kSteps[i].columns, cell.row + kSteps[i].rows};
      if (!grid.contains(next)) continue;
      const auto index = static_cast<std::uint32_t>(grid.index(next));
      if (costs.cost[index] == Costmap::kBlocked) continue;
      const float way_m = cost_m + share_m[i] * (costs.cost[here] + costs.cost[index]);
      if (is_better(index, way_m)) open(index, here, way_m, way_m + still_m(next));
    }
  }
  return way_;
}

void AStar::trace(const Grid& grid, std::uint32_t last) {
  for (std::uint32_t cell = last;; cell = nodes_[cell].before) {
    way_.push_back(grid.centre(grid.cell(cell)));
    if (nodes_[cell].before == cell) break;
  }
  std::reverse(way_.begin(), way_.end());
}

}  // namespace clew::map
