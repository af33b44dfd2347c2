// SPDX-License-Identifier: Apache-2.0
#include "map/costmap.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clew::map {
namespace {

constexpr double kPieceCells = 64.0;
// Of a grid over what was seen: 200 m x 200 m of cells of 50 mm.
constexpr double kMostCells = 1 << 24;

/// Falls from narrow_cost to 1 between touching and comfortable.
double narrow_cost(const Inflation& inflation, double distance_m) {
  const double room_m = inflation.comfortable_m - inflation.touching_m;
  const double share = room_m > 0.0 ? (distance_m - inflation.touching_m) / room_m : 1.0;
  return 1.0 + (inflation.narrow_cost - 1.0) * std::max(0.0, 1.0 - share);
}

}  // namespace

Inflation inflation_of(double radius_m, double hit_spread_m, double seen_cell_m) {
  // A hit lies anywhere in its cell, and a way passes anywhere in its.
  const double rounding_m = 0.5 * hit_spread_m + 0.5 * std::sqrt(2.0) * seen_cell_m;
  Inflation inflation;
  inflation.impossible_m = std::max(0.3 * radius_m, radius_m - rounding_m);
  inflation.touching_m = radius_m - kTouching_m;
  return inflation;
}

CostmapBuilder::CostmapBuilder(const Inflation& inflation, double seen_cell_m, Places places)
    : cell_m_(2.0 * seen_cell_m),
      places_(places),
      seen_free_cost_(static_cast<float>(inflation.seen_free_cost)),
      impossible_steps_(NearestMarks::steps_of(inflation.impossible_m)),
      touching_steps_(NearestMarks::steps_of(inflation.touching_m)),
      narrow_steps_(NearestMarks::steps_of(0.5 * (inflation.touching_m + inflation.comfortable_m))),
      nearest_(cell_m_, inflation.comfortable_m) {
  for (std::size_t i = 0; i < hit_cost_.size(); ++i) {
    const double distance_m = static_cast<double>(i) * NearestMarks::kStep_m;
    const double room_cost = narrow_cost(inflation, distance_m);
    const bool touches = i < touching_steps_;
    hit_cost_[i] = static_cast<float>(touches ? inflation.touching_cost : room_cost);
    suspected_cost_[i] = static_cast<float>(touches ? inflation.suspected_cost : room_cost);
  }
  hit_cost_[NearestMarks::kFar] = 1.0F;
  suspected_cost_[NearestMarks::kFar] = 1.0F;
  costs_.tells_moves = true;
}

/// What lies far away is left out if it makes the grid too large.
Grid CostmapBuilder::grid_over(const SeenMap& seen, const Vec2& from, const Vec2& to,
                               double margin_m, double reach_m) const {
  Vec2 least = from.cwiseMin(to);
  Vec2 most = from.cwiseMax(to);
  const Vec2 side(seen.tile_m(), seen.tile_m());
  const auto corner = [&](const TileKey& key) {
    return Vec2(key.first * seen.tile_m(), key.second * seen.tile_m());
  };
  if (const auto box = seen.box_within(from, reach_m)) {
    least = least.cwiseMin(corner(box->least));
    most = most.cwiseMax(corner(box->most) + side);
  }
  // In whole pieces: so the grid seldom grows.
  const double piece_m = kPieceCells * cell_m_;
  const Vec2 first = ((least.array() - margin_m) / piece_m).floor() * kPieceCells;
  const Vec2 end = ((most.array() + margin_m) / piece_m).ceil() * kPieceCells;
  const Vec2 cells = end - first;
  if (cells.x() * cells.y() > kMostCells) {
    double farthest_m = 0.0;
    for (const auto& entry : seen.state().tiles) {
      const double distance_m = seen.distance_m(entry.first, from);
      if (distance_m <= reach_m) farthest_m = std::max(farthest_m, distance_m);
    }
    if (farthest_m > margin_m) return grid_over(seen, from, to, margin_m, 0.5 * farthest_m);
  }
  return {cell_m_ * first, cell_m_, static_cast<std::int32_t>(cells.x()),
          static_cast<std::int32_t>(cells.y())};
}

const Costmap& CostmapBuilder::update(const SeenMap& seen, const Vec2& from, const Vec2& to,
                                      double margin_m, double reach_m) {
  ++costs_.revision;
  costs_.changed.clear();
  for (const std::size_t index : overruled_) charge(index);
  overruled_.clear();
  const Grid grid = grid_over(seen, from, to, margin_m, reach_m);
  if (grid != costs_.grid) {
    lay(places_ == Places::kInRing ? in_ring(costs_.grid, grid) : grid);
  }
  nearest_.update(costs_.grid, seen);
  for (const std::size_t index : nearest_.changed()) charge(index);
  return costs_;
}

/// Lays costs out for another grid.
void CostmapBuilder::lay(const Grid& grid) {
  const Grid before = costs_.grid;
  lay_out_anew(before, grid, 1.0F, costs_.cost, spare_costs_);
  lay_out_anew(before, grid, Clearance::kOpen, costs_.clearance, spare_clearances_);
  costs_.grid = grid;
  costs_.plain.lay(grid);
  // What has changed already: by the places of the new grid, and only what it has.
  const Cell shift = shift_between(before, grid);
  std::size_t kept = 0;
  for (const std::size_t index : costs_.changed) {
    const Cell cell = before.cell(index);
    const Cell now{cell.column - shift.column, cell.row - shift.row};
    if (grid.contains(now)) costs_.changed[kept++] = grid.index(now);
  }
  costs_.changed.resize(kept);
}

inline void CostmapBuilder::set_cost(std::size_t index, float cost) {
  const float before = std::exchange(costs_.cost[index], cost);
  if (before == cost) return;
  costs_.changed.push_back(index);
  const bool is_dear = cost != 1.0F;
  if ((before != 1.0F) == is_dear) return;
  if (is_dear) {
    costs_.plain.add(costs_.grid.cell(index));
  } else {
    costs_.plain.remove(costs_.grid.cell(index));
  }
}

void CostmapBuilder::overrule(std::size_t index, float cost, Clearance clearance) {
  set_cost(index, cost);
  costs_.clearance[index] = clearance;
  overruled_.push_back(index);
}

/// What a cell costs for its surroundings.
void CostmapBuilder::charge(std::size_t index) {
  const NearestMarks::Surroundings& cell = nearest_.cells()[index];
  const std::uint8_t by_hit = cell.steps[NearestMarks::kHit];
  const std::uint8_t by_suspected = cell.steps[NearestMarks::kSuspected];
  const Clearance clearance = by_hit < impossible_steps_       ? Clearance::kNone
                              : by_hit < touching_steps_       ? Clearance::kTouching
                              : by_suspected < touching_steps_ ? Clearance::kSuspected
                              : std::min(by_hit, by_suspected) < narrow_steps_ ? Clearance::kNarrow
                                                                               : Clearance::kOpen;
  float cost = std::max(hit_cost_[by_hit], suspected_cost_[by_suspected]);
  if (clearance == Clearance::kNone) cost = Costmap::kBlocked;
  costs_.clearance[index] = clearance;
  set_cost(index, cell.seen_free && seen_free_cost_ > 1.0F ? cost * seen_free_cost_ : cost);
}

}  // namespace clew::map
