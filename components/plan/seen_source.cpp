// SPDX-License-Identifier: Apache-2.0
#include "plan/seen_source.hpp"

namespace clew::plan {
namespace {

map::Inflation inflation_for(const map::LocalMap& local_map, const RoomNeeds& needs) {
  map::Inflation inflation = local_map.inflation();
  // Half way from touching to comfortable, a cell is open.
  inflation.comfortable_m = 2.0 * (needs.radius_m + needs.margin_m) - inflation.touching_m;
  return inflation;
}

}  // namespace

SeenSource::SeenSource(const map::LocalMapParameters& parameters, const RoomNeeds& needs)
    : local_map_(parameters, needs.radius_m),
      inflation_(inflation_for(local_map_, needs)),
      costmap_builder_(inflation_, parameters.cell_m) {}

RoomView SeenSource::read(const core::Vec2& from, const core::Vec2& to) {
  const map::Costmap& costs =
      costmap_builder_.update(local_map_.seen(), from, to, map::LocalMap::kAround_m);
  return {costs.grid, costs.clearance};
}

bool SeenSource::line_of_sight(const core::Vec2& from, const core::Vec2& to, map::Clearance least) {
  const auto is_near = [&](map::Mark mark) {
    return local_map_.is_near(mark, from, to, room_of(least), map::LocalMap::Ends::kFlat);
  };
  if (is_near(map::Mark::kHit)) return false;
  return least <= map::Clearance::kSuspected || !is_near(map::Mark::kSuspected);
}

/// How near a hit may be where there is this clearance, in metres.
double SeenSource::room_of(map::Clearance least) const {
  const double room_m = least == map::Clearance::kOpen
                            ? 0.5 * (inflation_.touching_m + inflation_.comfortable_m)
                        : least == map::Clearance::kTouching ? inflation_.impossible_m
                                                             : inflation_.touching_m;
  return room_m - local_map_.seen().cell_m();
}

}  // namespace clew::plan
