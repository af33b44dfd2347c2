// SPDX-License-Identifier: Apache-2.0
#include "map/distance_path.hpp"

namespace clew::map {

const std::vector<Vec2>& DistancePath::find(const Costmap& costs, const Vec2& from, const Vec2& to,
                                            double goal_radius_m) {
  way_.clear();
  const auto start = costs.grid.cell_at(from);
  if (!start) return way_;
  if (kept_[last_].goal_radius_m != goal_radius_m) last_ = 1 - last_;
  kept_[last_].goal_radius_m = goal_radius_m;
  cells_within(costs.grid, to, goal_radius_m, goals_);
  DistanceField& field = kept_[last_].field;
  field.take_in(costs, goals_);
  if (field.settle(*start) == DistanceField::kNone) return way_;
  field.path(costs, way_);
  return way_;
}

}  // namespace clew::map
