// SPDX-License-Identifier: Apache-2.0
#include "map/neural_path.hpp"

namespace clew::map {
namespace {

// Around a robot that stands closer to an obstacle than it would go, so that it can get away.
constexpr std::int32_t kStartCells = 3;

}  // namespace

const std::vector<Vec2>& NeuralPath::find(const Costmap& costs, const Vec2& from, const Vec2& to,
                                          double goal_radius_m) {
  way_.clear();
  const auto start = costs.grid.cell_at(from);
  if (!start) return way_;
  cells_within(costs.grid, to, goal_radius_m, targets_);
  take_room(costs, *start);
  const Clearance least = widest_.between(costs.grid, room_, *start, targets_);
  if (least == Clearance::kNone) return way_;
  passable_.resize(room_.size());
  for (std::size_t i = 0; i < room_.size(); ++i) {
    passable_[i] = room_[i] < least                        ? NeuralMap::kBlocked
                   : costs.clearance[i] < Clearance::kOpen ? NeuralMap::kDear
                                                           : NeuralMap::kFree;
  }
  landscape_.evolve(costs.grid, passable_, targets_, start);
  landscape_.path(*start, cells_);
  for (const Cell& cell : cells_) way_.push_back(costs.grid.centre(cell));
  return way_;
}

void NeuralPath::take_room(const Costmap& costs, const Cell& start) {
  room_ = costs.clearance;
  for (std::int32_t rows = -kStartCells; rows <= kStartCells; ++rows) {
    for (std::int32_t columns = -kStartCells; columns <= kStartCells; ++columns) {
      const Cell cell{start.column + columns, start.row + rows};
      if (!costs.grid.contains(cell)) continue;
      Clearance& room = room_[costs.grid.index(cell)];
      if (room != Clearance::kNone) room = Clearance::kOpen;
    }
  }
}

}  // namespace clew::map
