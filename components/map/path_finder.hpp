// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "map/costmap.hpp"
#include "map/path_search.hpp"

namespace clew::map {

/// Costs over a map, and a search on them: memory only, so that what it finds depends on the map
/// and on what is asked for alone.
struct PathFinder {
  Inflation inflation;
  CostmapBuilder costs;
  std::unique_ptr<PathSearch> search;
};

/// The finders of paths of least cost over one map: one for all who ask for the same costs.
class PathFinders {
 public:
  PathFinder& with(const Inflation& inflation, double seen_cell_m);

 private:
  std::vector<std::unique_ptr<PathFinder>> finders_;
};

}  // namespace clew::map
