// SPDX-License-Identifier: Apache-2.0
#include "map/path_finder.hpp"

#include "map/distance_path.hpp"

namespace clew::map {

PathFinder& PathFinders::with(const Inflation& inflation, double seen_cell_m) {
  for (const auto& finder : finders_) {
    if (finder->inflation == inflation) return *finder;
  }
  finders_.push_back(std::make_unique<PathFinder>(
      PathFinder{inflation, CostmapBuilder(inflation, seen_cell_m, CostmapBuilder::Places::kInRing),
                 std::make_unique<DistancePath>()}));
  return *finders_.back();
}

}  // namespace clew::map
