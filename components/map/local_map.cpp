// SPDX-License-Identifier: Apache-2.0
#include "map/local_map.hpp"

#include "core/segment.hpp"

namespace clew::map {

bool LocalMap::is_near(Mark mark, const Vec2& from, const Vec2& to, double distance_m,
                       Ends ends) const {
  const Vec2 margin(distance_m, distance_m);
  return seen_.find(mark, from.cwiseMin(to) - margin, from.cwiseMax(to) + margin,
                    [&](const Vec2& place) {
                      if (ends == Ends::kFlat) {
                        const double along = core::fraction_along(from, to, place);
                        if (along < 0.0 || along > 1.0) return false;
                      }
                      return core::distance_to_segment_m(from, to, place) < distance_m;
                    });
}

}  // namespace clew::map
