// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "trap_worlds/families.hpp"

namespace clew::trap_worlds {
namespace {

/// A niche beside the way, open toward it: at (x, y), as deep to the side as `side` has length.
void add_niche(WorldDraft& draft, const Vec2& mouth, double width_m, double side_m) {
  draft.add_walls({{mouth.x(), mouth.y()},
                   {mouth.x() + side_m, mouth.y()},
                   {mouth.x() + side_m, mouth.y() + width_m},
                   {mouth.x(), mouth.y() + width_m}});
}

}  // namespace

WorldDraft draw_look_alike(Dice& dice, double depth_m) {
  WorldDraft draft;
  const int niches = dice.count(2, 4);
  const double width_m = dice.between(0.8, 1.2);
  const double lane_m = dice.between(1.2, 1.8);
  const double pitch_m = width_m + dice.between(1.0, 1.6);
  draft.say_count("niches", niches);
  draft.say("lane", lane_m);
  // Along a lane with equal niches on its right, each with a length of wall before and after it.
  const double x_m = 0.5 * lane_m;
  double y_m = 0.0;
  for (int i = 0; i < niches; ++i) {
    draft.add_walls({{x_m, y_m}, {x_m, y_m + pitch_m - width_m}});
    y_m += pitch_m - width_m;
    add_niche(draft, {x_m, y_m}, width_m, depth_m);
    y_m += width_m;
  }
  draft.add_walls({{x_m, y_m}, {x_m, y_m + 0.6}});
  draft.add_walls({{-x_m, 0.0}, {-x_m, y_m + 0.6}});
  draft.start = {dice.between(-0.2, 0.2), -dice.between(0.5, 1.0)};
  draft.target = {dice.between(-0.2, 0.2), y_m + dice.between(1.2, 2.0)};
  return draft;
}

WorldDraft draw_clutter(Dice& dice, double depth_m) {
  WorldDraft draft;
  const double size_m = 6.0 + depth_m;
  const double gap_m = dice.between(0.6, 1.0);
  draft.start = {0.0, 0.0};
  draft.target = {dice.between(-1.0, 1.0), size_m};
  const int tries = static_cast<int>(40.0 * size_m);
  for (int i = 0; i < tries; ++i) {
    const world::World::Circle circle{
        {dice.between(-0.5, 0.5) * size_m, dice.between(0.0, 1.0) * size_m},
        dice.between(0.1, 0.5)};
    const auto is_near = [&](const Vec2& p, double room_m) {
      return core::length(p - circle.centre) < circle.radius_m + room_m;
    };
    const bool taken =
        is_near(draft.start, 0.6) || is_near(draft.target, 0.6) ||
        std::any_of(draft.circles.begin(), draft.circles.end(), [&](const auto& other) {
          return is_near(other.centre, other.radius_m + gap_m);
        });
    if (!taken) draft.circles.push_back(circle);
  }
  draft.say("least gap", gap_m);
  draft.say_count("obstacles", static_cast<int>(draft.circles.size()));
  return draft;
}

WorldDraft draw_unreachable(Dice& dice, double depth_m) {
  WorldDraft draft;
  const double width_m = dice.between(1.0, 2.0) + depth_m;
  const double height_m = dice.between(1.0, 2.0) + 0.5 * depth_m;
  draft.say("width", width_m);
  draft.say("height", height_m);
  const double half_m = 0.5 * width_m;
  draft.add_walls(
      {{-half_m, 0.0}, {-half_m, height_m}, {half_m, height_m}, {half_m, 0.0}, {-half_m, 0.0}});
  draft.start = {dice.between(-1.0, 1.0) * half_m, -dice.between(1.0, 2.0)};
  draft.target = {dice.between(-0.2, 0.2), 0.5 * height_m};
  return draft;
}

}  // namespace clew::trap_worlds
