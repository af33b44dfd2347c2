// SPDX-License-Identifier: Apache-2.0
#include "map/smooth_path.hpp"

#include <algorithm>
#include <cmath>

namespace clew::map {
namespace {

constexpr double kStepCells = 0.5;
// Steps within one cell: even a diagonal of it takes no more.
constexpr int kStepsInACell = 4;

class Landscape {
 public:
  explicit Landscape(const NeuralMap& map) : map_(map) {}

  Vec2 middle(const Cell& cell) const { return centre(map_.lattice(), map_.grid(), cell); }

  // Of the interpolated logarithm, a cell; null where nothing can be told.
  Vec2 slope_at(const Vec2& place, const Cell& cell) const {
    Vec2 sum = weight(place, cell) * slope_of(cell);
    for (const Cell& other : neighbours(map_.lattice(), cell)) {
      if (map_.active(other)) sum += weight(place, other) * slope_of(other);
    }
    return sum;
  }

 private:
  // Of the best plane through the cell's own logarithm and its neighbours'.
  Vec2 slope_of(const Cell& cell) const {
    double xx = 0.0;
    double xy = 0.0;
    double yy = 0.0;
    Vec2 rise = Vec2::Zero();
    const double own = map_.log_activation(cell);
    for (const Cell& other : neighbours(map_.lattice(), cell)) {
      if (!map_.active(other)) continue;
      const Vec2 way = (middle(other) - middle(cell)) / map_.grid().cell_m;
      const double weight = 1.0 / (way.x() * way.x() + way.y() * way.y());
      xx += weight * way.x() * way.x();
      xy += weight * way.x() * way.y();
      yy += weight * way.y() * way.y();
      rise += weight * (map_.log_activation(other) - own) * way;
    }
    const double determinant = xx * yy - xy * xy;
    // All neighbours in one line.
    if (!(determinant > 1e-9)) return rise;
    return Vec2(yy * rise.x() - xy * rise.y(), xx * rise.y() - xy * rise.x()) / determinant;
  }

  // 1 in the middle of a cell, falling to 0 a column or a row away.
  double weight(const Vec2& place, const Cell& cell) const {
    const Vec2 away = (place - middle(cell)).cwiseAbs() / map_.grid().cell_m;
    return std::max(0.0, 1.0 - away.x()) *
           std::max(0.0, 1.0 - away.y() / row_distance(map_.lattice()));
  }

  const NeuralMap& map_;
};

}  // namespace

bool smooth_path(const NeuralMap& landscape, const Cell& from, std::vector<Vec2>& places) {
  places.clear();
  if (!landscape.active(from)) return false;
  const Landscape interpolated(landscape);
  Cell cell = from;
  Vec2 place = interpolated.middle(cell);
  int steps_here = 0;
  for (auto next = landscape.ascent(cell); next.has_value(); next = landscape.ascent(cell)) {
    places.push_back(place);
    const Vec2 slope = interpolated.slope_at(place, cell);
    const double steepness = core::length(slope);
    const Vec2 ahead = steepness > 0.0
                           ? Vec2(place + kStepCells * landscape.grid().cell_m / steepness * slope)
                           : place;
    const auto there = cell_at(landscape.lattice(), landscape.grid(), ahead);
    const bool stays = there.has_value() && *there == cell && ++steps_here < kStepsInACell;
    const bool climbs = there.has_value() && landscape.above(*there, cell);
    if (!stays) steps_here = 0;
    if (stays || climbs) {
      place = ahead;
      cell = *there;
    } else {
      cell = *next;
      place = interpolated.middle(cell);
    }
  }
  places.push_back(interpolated.middle(cell));
  return true;
}

}  // namespace clew::map
