// SPDX-License-Identifier: Apache-2.0
#include "map/tight_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace clew::map {
namespace {

// A piece is kept straight if that costs this much more at most: sums of costs are rounded.
constexpr double kSameCost_ratio = 1.001;
// Half a cell apart, so many places in a row from one on lie within PlainBlocks::kSide of it.
constexpr double kPlacesAcross = 2.0 * PlainBlocks::kSide;

/// What going straight costs; infinite through what is blocked, and where it is more than `most_m`
/// for certain: costs only add up. Both places lie within the grid.
double straight_cost_m(const Costmap& costs, const Vec2& from, const Vec2& to, double most_m) {
  const Grid& grid = costs.grid;
  const double length_m = core::length(to - from);
  const auto pieces = static_cast<int>(std::ceil(length_m / (0.5 * grid.cell_m)));
  if (pieces == 0) return 0.0;
  const Vec2 piece = (to - from) / (grid.cell_m * pieces);  // in cells
  const Vec2 first = (from - grid.corner) / grid.cell_m + 0.5 * piece;
  const double most = most_m * pieces / length_m * kSameCost_ratio;
  const float* cost = costs.cost.data();
  const auto cell_at = [&](double i) {
    return Cell{static_cast<std::int32_t>(first.x() + i * piece.x()),
                static_cast<std::int32_t>(first.y() + i * piece.y())};
  };
  const auto index_at = [&](double i) { return grid.index(cell_at(i)); };
  // Costs are multiples of 2^-23 and few, so their sums are exact, whatever the order.
  double sum = 0.0;
  double i = 0.0;
  while (i + 4.0 <= pieces) {
    const Cell cell = cell_at(i);
    if (costs.plain.is_plain_around(cell.column, cell.row)) {
      const double plain = std::min(kPlacesAcross, pieces - i);
      sum += plain;
      i += plain;
      continue;
    }
    const float a = cost[index_at(i)];
    const float b = cost[index_at(i + 1.0)];
    const float c = cost[index_at(i + 2.0)];
    const float d = cost[index_at(i + 3.0)];
    if (std::min(std::min(a, b), std::min(c, d)) == Costmap::kBlocked) return HUGE_VAL;
    sum += (double{a} + double{b}) + (double{c} + double{d});
    i += 4.0;
    if (sum > most) return HUGE_VAL;
  }
  for (; i < pieces; i += 1.0) {
    const float last = cost[index_at(i)];
    if (last == Costmap::kBlocked) return HUGE_VAL;
    sum += last;
  }
  if (sum > most) return HUGE_VAL;
  return sum * length_m / pieces;
}

/// What a step from a cell to a neighbour costs, from a place in the one.
double step_cost_m(const Costmap& costs, const Vec2& from, const Vec2& to) {
  const auto cost_at = [&](const Vec2& place) {
    return costs.cost[costs.grid.index(*costs.grid.cell_at(place))];
  };
  return 0.5 * (cost_at(from) + cost_at(to)) * core::length(to - from);
}

}  // namespace

void pull_tight(const Costmap& costs, const std::vector<Vec2>& path, const Vec2& from,
                std::vector<Vec2>& corners) {
  corners.push_back(from);
  Vec2 corner = from;
  double along_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double step_m = step_cost_m(costs, i == 1 ? from : path[i - 1], path[i]);
    const double allowed_m = kSameCost_ratio * (along_m + step_m);
    if (i > 1 && straight_cost_m(costs, corner, path[i], allowed_m) > allowed_m) {
      corner = path[i - 1];
      corners.push_back(corner);
      along_m = 0.0;
    }
    along_m += step_m;
  }
  corners.push_back(path.back());
}

}  // namespace clew::map
