// SPDX-License-Identifier: Apache-2.0
#include "map/costmap.hpp"

#include <algorithm>
#include <cmath>

namespace clew::map {
namespace {

constexpr double kStep_m = 0.0025;  // in which distances are kept
constexpr std::uint8_t kFar = 255;

std::uint8_t steps_of(double distance_m) {
  return static_cast<std::uint8_t>(std::min(255.0, std::floor(distance_m / kStep_m + 0.5)));
}

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

CostmapBuilder::CostmapBuilder(const Inflation& inflation, double seen_cell_m)
    : cell_m_(2.0 * seen_cell_m),
      seen_free_cost_(static_cast<float>(inflation.seen_free_cost)),
      impossible_steps_(steps_of(inflation.impossible_m)),
      touching_steps_(steps_of(inflation.touching_m)),
      narrow_steps_(steps_of(0.5 * (inflation.touching_m + inflation.comfortable_m))) {
  const auto reach = static_cast<std::int32_t>(std::ceil(inflation.comfortable_m / cell_m_)) + 1;
  for (std::size_t quarter = 0; quarter < around_.size(); ++quarter) {
    const Vec2 place(quarter % 2 == 0 ? 0.25 : 0.75, quarter < 2 ? 0.25 : 0.75);
    for (std::int32_t rows = -reach; rows <= reach; ++rows) {
      for (std::int32_t columns = -reach; columns <= reach; ++columns) {
        const double distance_m = cell_m_ * core::length(Vec2(columns + 0.5, rows + 0.5) - place);
        if (distance_m > inflation.comfortable_m) continue;
        around_[quarter].push_back({columns, rows, steps_of(distance_m)});
      }
    }
  }
  for (std::size_t i = 0; i < hit_cost_.size(); ++i) {
    const double distance_m = static_cast<double>(i) * kStep_m;
    const double room_cost = narrow_cost(inflation, distance_m);
    const bool touches = i < touching_steps_;
    hit_cost_[i] = static_cast<float>(touches ? inflation.touching_cost : room_cost);
    suspected_cost_[i] = static_cast<float>(touches ? inflation.suspected_cost : room_cost);
  }
  hit_cost_[kFar] = 1.0F;
  suspected_cost_[kFar] = 1.0F;
}

void CostmapBuilder::lay_grid(const SeenMap& seen, const Vec2& from, const Vec2& to,
                              double margin_m, double reach_m) {
  Vec2 least = from.cwiseMin(to);
  Vec2 most = from.cwiseMax(to);
  for (const auto& [key, tile] : seen.state().tiles) {
    const Vec2 corner(key.first * seen.tile_m(), key.second * seen.tile_m());
    if (seen.distance_m(key, from) > reach_m) continue;
    least = least.cwiseMin(corner);
    most = most.cwiseMax(corner + Vec2(seen.tile_m(), seen.tile_m()));
  }
  const auto first = [&](double at_m) { return std::floor((at_m - margin_m) / cell_m_); };
  const auto end = [&](double at_m) { return std::ceil((at_m + margin_m) / cell_m_); };
  Grid& grid = costs_.grid;
  grid.cell_m = cell_m_;
  grid.corner = cell_m_ * Vec2(first(least.x()), first(least.y()));
  grid.columns = static_cast<std::int32_t>(end(most.x()) - first(least.x()));
  grid.rows = static_cast<std::int32_t>(end(most.y()) - first(least.y()));
}

Costmap& CostmapBuilder::update(const SeenMap& seen, const Vec2& from, const Vec2& to,
                                double margin_m, double reach_m) {
  lay_grid(seen, from, to, margin_m, reach_m);
  const Grid& grid = costs_.grid;
  hit_steps_.assign(grid.size(), kFar);
  suspected_steps_.assign(grid.size(), kFar);
  const Vec2 most = grid.corner + cell_m_ * Vec2(grid.columns, grid.rows);
  const auto stamp = [&](const Vec2& place, std::vector<std::uint8_t>& all_steps) {
    const Vec2 steps = (place - grid.corner) / cell_m_;
    const Cell cell{static_cast<std::int32_t>(std::floor(steps.x())),
                    static_cast<std::int32_t>(std::floor(steps.y()))};
    const std::size_t quarter =
        (steps.x() - cell.column < 0.5 ? 0U : 1U) + (steps.y() - cell.row < 0.5 ? 0U : 2U);
    for (const Offset& offset : around_[quarter]) {
      const Cell near{cell.column + offset.columns, cell.row + offset.rows};
      if (!grid.contains(near)) continue;
      std::uint8_t& now = all_steps[grid.index(near)];
      now = std::min(now, offset.steps);
    }
  };
  seen.for_each(Mark::kHit, grid.corner, most,
                [&](const Vec2& place) { stamp(place, hit_steps_); });
  seen.for_each(Mark::kSuspected, grid.corner, most,
                [&](const Vec2& place) { stamp(place, suspected_steps_); });
  costs_.cost.resize(grid.size());
  costs_.clearance.resize(grid.size());
  for (std::size_t i = 0; i < costs_.cost.size(); ++i) {
    const std::uint8_t by_hit = hit_steps_[i];
    const std::uint8_t by_suspected = suspected_steps_[i];
    costs_.cost[i] = std::max(hit_cost_[by_hit], suspected_cost_[by_suspected]);
    costs_.clearance[i] = by_hit < impossible_steps_                       ? Clearance::kNone
                          : by_hit < touching_steps_                       ? Clearance::kTouching
                          : by_suspected < touching_steps_                 ? Clearance::kSuspected
                          : std::min(by_hit, by_suspected) < narrow_steps_ ? Clearance::kNarrow
                                                                           : Clearance::kOpen;
    if (costs_.clearance[i] == Clearance::kNone) costs_.cost[i] = Costmap::kBlocked;
  }
  if (seen_free_cost_ > 1.0F) charge_for_seen_free(seen);
  return costs_;
}

void CostmapBuilder::charge_for_seen_free(const SeenMap& seen) {
  const Grid& grid = costs_.grid;
  seen.for_each(
      Mark::kFree, grid.corner, grid.corner + cell_m_ * Vec2(grid.columns, grid.rows),
      [&](const Vec2& place) {
        const Vec2 steps = (place - grid.corner) / cell_m_;
        const Cell cell{static_cast<std::int32_t>(steps.x()), static_cast<std::int32_t>(steps.y())};
        // One of a cell's four quarters stands for it.
        const bool first = steps.x() - cell.column < 0.5 && steps.y() - cell.row < 0.5;
        if (first) costs_.cost[grid.index(cell)] *= seen_free_cost_;
      });
}

}  // namespace clew::map
