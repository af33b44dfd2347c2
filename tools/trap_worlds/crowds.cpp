// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "trap_worlds/families.hpp"

namespace clew::trap_worlds {
namespace {

constexpr double kWalk_s = 180.0;    // longer than a robot needs through the hall
constexpr double kFromWall_m = 0.5;  // of the middle of who walks
constexpr double kLeastLeg_m = 2.0;
constexpr double kClearOfStart_m = 1.5;

/// The hall in which people walk, the middle of its near wall at the origin.
struct Hall {
  double half_width_m = 0.0;
  double length_m = 0.0;

  Vec2 any_place(Dice& dice) const {
    const double half_m = half_width_m - kFromWall_m;
    const double x_m = dice.between(-half_m, half_m);
    return {x_m, dice.between(kFromWall_m, length_m - kFromWall_m)};
  }
  /// As far off as a leg is long; the hall is wide enough that there is such a place.
  Vec2 far_place(Dice& dice, const Vec2& from, double least_m) const {
    Vec2 place = any_place(dice);
    while (core::length(place - from) < least_m) place = any_place(dice);
    return place;
  }
};

/// Walks from place to place at a speed of its own, and in the end to the wall beside it.
world::MovingObstacle walker(Dice& dice, const Hall& hall, const Vec2& start) {
  world::MovingObstacle one;
  one.radius_m = dice.between(0.2, 0.3);
  const double speed_mps = dice.between(0.3, 0.8);
  double time_s = 0.0;
  Vec2 place = hall.far_place(dice, start, kClearOfStart_m);
  const auto go_to = [&](const Vec2& next) {
    time_s += core::length(next - place) / speed_mps;
    place = next;
    one.path.push_back({time_s, place});
  };
  one.path.push_back({time_s, place});
  while (time_s < kWalk_s) go_to(hall.far_place(dice, place, kLeastLeg_m));
  const double wall_m = hall.half_width_m - kFromWall_m + 0.1;
  const Vec2 beside(place.x() < 0.0 ? -wall_m : wall_m, place.y());
  if (beside != place) go_to(beside);
  return one;
}

}  // namespace

WorldDraft draw_crowd(Dice& dice, double depth_m) {
  WorldDraft draft;
  const Hall hall{dice.between(2.5, 3.5), dice.between(8.0, 11.0)};
  const int people = 2 + static_cast<int>(1.5 * depth_m);
  draft.say("width", 2.0 * hall.half_width_m);
  draft.say("length", hall.length_m);
  draft.say_count("people", people);
  draft.add_walls({{-hall.half_width_m, 0.0},
                   {hall.half_width_m, 0.0},
                   {hall.half_width_m, hall.length_m},
                   {-hall.half_width_m, hall.length_m},
                   {-hall.half_width_m, 0.0}});
  draft.start = {dice.between(-1.0, 1.0), 0.8};
  draft.target = {dice.between(-1.0, 1.0), hall.length_m - 0.8};
  for (int i = 0; i < people; ++i) draft.moving.push_back(walker(dice, hall, draft.start));
  draft.border_m = 0.2;
  return draft;
}

}  // namespace clew::trap_worlds
