// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "map/costmap.hpp"

namespace clew::map {

/// Finds a way over the cells of a grid. A search holds nothing but memory to work in, so that what
/// it finds depends on its arguments alone.
class PathSearch {
 public:
  virtual ~PathSearch() = default;

  /// A way from the middle of the cell of `from` to that of a cell within `goal_radius_m` of `to`,
  /// in short steps from place to place; empty if there is none. Both places lie within the grid.
  virtual const std::vector<Vec2>& find(const Costmap& costs, const Vec2& from, const Vec2& to,
                                        double goal_radius_m) = 0;
};

}  // namespace clew::map
