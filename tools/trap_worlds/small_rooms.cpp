// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "trap_worlds/families.hpp"

namespace clew::trap_worlds {
namespace {

// A disc of 0.15 m radius passes gaps from 0.3 m on.
constexpr double kLeastGap_m = 0.25;
constexpr double kMostGap_m = 0.7;

Vec2 place_in(Dice& dice, double size_m) {
  const double x_m = dice.between(0.0, size_m);
  return {x_m, dice.between(0.0, size_m)};
}

/// A wall from one place to another with a gap in it, or none.
void add_wall_with_gap(Dice& dice, const Vec2& from, const Vec2& to, bool open, WorldDraft& draft) {
  const double length_m = core::length(to - from);
  const double gap_m = std::min(length_m, dice.between(kLeastGap_m, kMostGap_m));
  const double first_m = dice.between(0.0, length_m - gap_m);
  if (!open) {
    draft.add_walls({from, to});
    return;
  }
  const Vec2 along = (to - from) / length_m;
  draft.add_walls({from, from + first_m * along});
  draft.add_walls({from + (first_m + gap_m) * along, to});
}

/// From side to side of the room.
void add_partition(Dice& dice, double size_m, WorldDraft& draft) {
  const double at_m = dice.between(0.2, 0.8) * size_m;
  const double other_m = std::clamp(at_m + dice.between(-1.0, 1.0), 0.0, size_m);
  const bool upright = dice.coin();
  const Vec2 from = upright ? Vec2(at_m, 0.0) : Vec2(0.0, at_m);
  const Vec2 to = upright ? Vec2(other_m, size_m) : Vec2(size_m, other_m);
  add_wall_with_gap(dice, from, to, dice.count(0, 3) > 0, draft);
}

/// Around the target, one of its walls with a gap more often than not.
void add_closet(Dice& dice, WorldDraft& draft) {
  const Vec2 least = draft.target - Vec2{dice.between(0.2, 0.7), dice.between(0.2, 0.7)};
  const Vec2 most = draft.target + Vec2{dice.between(0.2, 0.7), dice.between(0.2, 0.7)};
  const Vec2 right(most.x(), least.y());
  const Vec2 left(least.x(), most.y());
  draft.add_walls({right, most, left, least});
  add_wall_with_gap(dice, least, right, dice.count(0, 2) > 0, draft);
}

void add_clutter(Dice& dice, double size_m, WorldDraft& draft) {
  const int walls = dice.count(0, 3 + static_cast<int>(size_m));
  for (int i = 0; i < walls; ++i) {
    const Vec2 from = place_in(dice, size_m);
    const double any_rad = dice.between(-core::kPi, core::kPi);
    const double direction_rad = dice.coin() ? any_rad : 0.5 * core::kPi * dice.count(0, 3);
    draft.add_walls(
        {from, from + dice.between(0.05, 0.5 * size_m) * core::direction(direction_rad)});
  }
  const int circles = dice.count(0, 3);
  for (int i = 0; i < circles; ++i) {
    const Vec2 centre = place_in(dice, size_m);
    draft.circles.push_back({centre, dice.between(0.02, 0.4)});
  }
  const int triangles = dice.count(0, 2);
  for (int i = 0; i < triangles; ++i) {
    const Vec2 corner = place_in(dice, size_m);
    const double first_rad = dice.between(-core::kPi, core::kPi);
    const double second_rad = first_rad + dice.between(0.4, 2.7);
    const Vec2 second = corner + dice.between(0.1, 1.0) * core::direction(first_rad);
    draft.polygons.push_back(
        {corner, second, corner + dice.between(0.1, 1.0) * core::direction(second_rad)});
  }
}

}  // namespace

WorldDraft draw_small_room(Dice& dice, double depth_m) {
  WorldDraft draft;
  const double size_m = 2.0 + 0.5 * depth_m;
  draft.say("size", size_m);
  draft.start = place_in(dice, size_m);
  draft.target = place_in(dice, size_m);
  draft.target_radius_m = dice.between(0.02, 0.3);
  draft.off_target_rad = dice.between(-core::kPi, core::kPi);
  draft.border_m = dice.between(0.0, 0.5);
  draft.add_walls({{0.0, 0.0}, {size_m, 0.0}, {size_m, size_m}, {0.0, size_m}, {0.0, 0.0}});
  const int partitions = dice.count(0, 2);
  for (int i = 0; i < partitions; ++i) add_partition(dice, size_m, draft);
  if (dice.count(0, 2) == 0) add_closet(dice, draft);
  add_clutter(dice, size_m, draft);
  return draft;
}

}  // namespace clew::trap_worlds
