// SPDX-License-Identifier: Apache-2.0
#include "map/local_map.hpp"

#include "core/segment.hpp"

namespace clew::map {

bool LocalMap::is_near(Mark mark, const Vec2& from, const Vec2& to, double distance_m,
                       Ends ends) const {
  const Vec2 margin(distance_m, distance_m);
  const double reach_m = distance_m + seen_.tile_m();  // more than half a tile's diagonal
  const auto may_be_in = [&](const Vec2& middle) {
    return core::distance_to_segment_m(from, to, middle) < reach_m;
  };
  const auto is_it = [&](const Vec2& place) {
    if (ends == Ends::kFlat) {
      const double along = core::fraction_along(from, to, place);
      if (along < 0.0 || along > 1.0) return false;
    }
    return core::distance_to_segment_m(from, to, place) < distance_m;
  };
  return seen_.find(mark, from.cwiseMin(to) - margin, from.cwiseMax(to) + margin, may_be_in, is_it);
}

}  // namespace clew::map
