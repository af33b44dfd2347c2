// SPDX-License-Identifier: Apache-2.0
#include "plan/seen_source.hpp"

namespace clew::plan {
namespace {

// Free room around all that was seen, wide enough to go round it.
constexpr double kAround_m = 1.0;
// Free parts of beams end this far before what returned.
constexpr double kClearMargin_m = 0.01;

map::Inflation inflation_of(const SeenSource::Parameters& p, const RoomNeeds& needs) {
  map::Inflation inflation = map::inflation_of(needs.radius_m, p.hit_spread_m, 0.5 * p.cell_m);
  // Half way from touching to comfortable, a cell is open.
  inflation.comfortable_m = 2.0 * (needs.radius_m + needs.margin_m) - inflation.touching_m;
  return inflation;
}

}  // namespace

SeenSource::SeenSource(const Parameters& parameters, const RoomNeeds& needs)
    : evidence_({parameters.hit_spread_m, kClearMargin_m}, needs.radius_m),
      seen_(0.5 * parameters.cell_m, parameters.capacity_tiles),
      inflation_(inflation_of(parameters, needs)),
      clearance_(inflation_, seen_.cell_m()) {}

RoomView SeenSource::read(const core::Vec2& from, const core::Vec2& to) {
  const map::Costmap& costs = clearance_.update(seen_, from, to, kAround_m);
  return {costs.grid, costs.clearance};
}

bool SeenSource::line_of_sight(const core::Vec2& from, const core::Vec2& to, map::Clearance least) {
  if (is_near(map::Mark::kHit, from, to, room_of(least))) return false;
  if (least <= map::Clearance::kSuspected) return true;
  return !is_near(map::Mark::kSuspected, from, to, room_of(least));
}

/// How near a hit may be where there is this room, in metres.
double SeenSource::room_of(map::Clearance least) const {
  const double room_m = least == map::Clearance::kOpen
                            ? 0.5 * (inflation_.touching_m + inflation_.comfortable_m)
                        : least == map::Clearance::kTouching ? inflation_.impossible_m
                                                             : inflation_.touching_m;
  return room_m - seen_.cell_m();
}

bool SeenSource::is_near(map::Mark mark, const core::Vec2& from, const core::Vec2& to,
                         double room_m) const {
  const core::Vec2 way = to - from;
  const double square = way.dot(way);
  const core::Vec2 margin(room_m, room_m);
  bool near = false;
  seen_.for_each(mark, from.cwiseMin(to) - margin, from.cwiseMax(to) + margin,
                 [&](const core::Vec2& place) {
                   const core::Vec2 off = place - from;
                   // Beside either end counts with the line, before and behind it does not.
                   const double along = square > 0.0 ? off.dot(way) / square : 0.0;
                   if (along < 0.0 || along > 1.0) return;
                   near = near || core::length(off - along * way) < room_m;
                 });
  return near;
}

void SeenSource::save(core::StateWriter& writer) const { writer(seen_.state()); }

}  // namespace clew::plan
