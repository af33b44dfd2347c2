// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "trap_worlds/families.hpp"

namespace clew::trap_worlds {
namespace {

constexpr double kRobotWidth_m = 0.3;
constexpr double kFastest_mps = 0.8;  // of the drives that ship

}  // namespace

WorldDraft draw_double_wall(Dice& dice, double depth_m) {
  WorldDraft draft;
  const double between_m = dice.between(1.0, 1.8);
  const double overlap_m = std::max(depth_m, 0.6);
  const double far_m = overlap_m + dice.between(1.0, 2.0);
  draft.say("distance of the walls", between_m);
  draft.say("overlap", overlap_m);
  // The front wall leaves its way on the right, the back wall on the left; the outer walls close
  // the other ends.
  draft.add_walls({{-far_m, -1.0}, {-far_m, 0.0}, {overlap_m, 0.0}});
  draft.add_walls({{-overlap_m, between_m}, {far_m, between_m}, {far_m, -1.0}});
  draft.start = {dice.between(-0.3, 0.3), -dice.between(1.0, 2.0)};
  draft.target = {dice.between(-0.3, 0.3), between_m + dice.between(0.8, 1.6)};
  return draft;
}

WorldDraft draw_slits(Dice& dice, double depth_m) {
  WorldDraft draft;
  const double half_m = dice.between(1.2, 2.4);
  const double slit_m = kRobotWidth_m * dice.between(0.3, 0.8);
  const double piece_m = dice.between(0.4, 0.8);
  draft.say("width", 2.0 * half_m);
  draft.say("slit", slit_m);
  for (double x_m = -half_m; x_m < half_m; x_m += piece_m + slit_m) {
    draft.add_walls({{x_m, 0.0}, {std::min(x_m + piece_m, half_m), 0.0}});
  }
  draft.add_walls({{-half_m, 0.0}, {-half_m, -depth_m}});
  draft.add_walls({{half_m - slit_m, 0.0}, {half_m, 0.0}, {half_m, -depth_m}});
  draft.start = {dice.between(-0.3, 0.3), -depth_m - dice.between(0.8, 1.6)};
  draft.target = {dice.between(-0.5, 0.5), dice.between(0.8, 1.6)};
  return draft;
}

WorldDraft draw_staggered_baffles(Dice& dice, double depth_m) {
  WorldDraft draft;
  const double width_m = dice.between(2.2, 3.2);
  const double gap_m = dice.between(0.8, 1.1);
  const double spacing_m = dice.between(0.9, 1.3);
  const int baffles = 2 + std::min(static_cast<int>(depth_m / spacing_m), 6);
  draft.say("corridor", width_m);
  draft.say("gap", gap_m);
  draft.say_count("baffles", baffles);
  const double half_m = 0.5 * width_m;
  const double length_m = spacing_m * static_cast<double>(baffles + 1);
  draft.add_walls({{-half_m, 0.0}, {-half_m, length_m}});
  draft.add_walls({{half_m, 0.0}, {half_m, length_m}});
  for (int i = 0; i < baffles; ++i) {
    const double y_m = spacing_m * static_cast<double>(i + 1);
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    draft.add_walls({{-side * half_m, y_m}, {side * (half_m - gap_m), y_m}});
  }
  draft.start = {dice.between(-0.3, 0.3), -dice.between(0.5, 1.0)};
  draft.target = {dice.between(-0.3, 0.3), length_m + dice.between(0.5, 1.0)};
  return draft;
}

WorldDraft draw_symmetric_wall(Dice& dice, double depth_m) {
  WorldDraft draft;
  const double away_m = dice.between(1.0, 2.0);
  draft.say("half length", depth_m);
  draft.add_walls({{-depth_m, 0.0}, {depth_m, 0.0}});
  draft.start = {0.0, -dice.between(1.5, 2.5)};
  draft.target = {0.0, away_m};
  draft.may_be_turned = false;
  return draft;
}

WorldDraft draw_closing_door(Dice& dice, double depth_m) {
  WorldDraft draft;
  const double door_m = dice.between(0.9, 1.2);
  const double side_m = std::max(depth_m, 0.6);
  const double far_door_m = side_m + dice.between(2.0, 3.0);
  draft.say("door", door_m);
  draft.say("second door at", far_door_m);
  draft.say("side walls", side_m);
  const double half_m = 0.5 * door_m;
  const double left_m = -far_door_m - 1.5;
  const double right_m = far_door_m + door_m + 1.5;
  // The near door is in the back of a U, the far one beside it, in a wall from side to side.
  draft.add_walls({{-1.4, -side_m}, {-1.4, 0.0}, {1.4, 0.0}, {1.4, -side_m}});
  draft.walls[1].b.x() = -half_m;
  draft.add_walls({{half_m, 0.0}, {1.4, 0.0}});
  draft.add_walls({{left_m, 0.0}, {-1.4, 0.0}});
  draft.add_walls({{1.4, 0.0}, {far_door_m, 0.0}});
  draft.add_walls({{far_door_m + door_m, 0.0}, {right_m, 0.0}});
  draft.start = {dice.between(-0.3, 0.3), -side_m - dice.between(3.5, 4.5)};
  // A round leaf behind the wall comes before the door and then into it, before any robot can be
  // there: to be run over is no trap.
  const double closed_s = -draft.start.y() / kFastest_mps - dice.between(0.5, 1.5);
  draft.say_time("closed after", closed_s);
  const double leaf_m = half_m - 0.05;
  const double aside_m = half_m + leaf_m + 0.1;
  world::MovingObstacle leaf;
  leaf.radius_m = leaf_m;
  leaf.path = {{0.0, {aside_m, leaf_m + 0.1}},
               {closed_s - 3.0, {aside_m, leaf_m + 0.1}},
               {closed_s - 1.5, {0.0, leaf_m + 0.1}},
               {closed_s, {0.0, 0.0}}};
  draft.moving = {leaf};
  draft.target = {dice.between(-0.5, 0.5), 2.0 * leaf_m + dice.between(1.0, 1.6)};
  const double front_m = draft.start.y() - 1.5;
  const double back_m = draft.target.y() + 1.5;
  draft.add_walls({{left_m, front_m},
                   {right_m, front_m},
                   {right_m, back_m},
                   {left_m, back_m},
                   {left_m, front_m}});
  draft.border_m = 0.2;
  draft.may_be_turned = false;
  return draft;
}

}  // namespace clew::trap_worlds
