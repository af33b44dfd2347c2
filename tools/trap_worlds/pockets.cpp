// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "trap_worlds/families.hpp"

namespace clew::trap_worlds {
namespace {

constexpr int kRingSides = 32;

/// Start and target in front of and behind something that reaches from front_y_m to back_y_m.
void place_ends(WorldDraft& draft, Dice& dice, double front_y_m, double back_y_m) {
  draft.start = {dice.between(-0.3, 0.3), front_y_m - dice.between(0.8, 1.6)};
  draft.target = {dice.between(-0.5, 0.5), back_y_m + dice.between(0.8, 1.6)};
}

/// Three walls of a U whose back is at y = 0 and whose opening looks down.
void add_u(WorldDraft& draft, double width_m, double depth_m, double back_y_m) {
  const double half_m = 0.5 * width_m;
  draft.add_walls({{-half_m, back_y_m - depth_m},
                   {-half_m, back_y_m},
                   {half_m, back_y_m},
                   {half_m, back_y_m - depth_m}});
}

}  // namespace

WorldDraft draw_u(Dice& dice, double depth_m) {
  WorldDraft draft;
  const double width_m = dice.between(1.4, 4.0);
  draft.say("width", width_m);
  add_u(draft, width_m, depth_m, 0.0);
  place_ends(draft, dice, -depth_m, 0.0);
  return draft;
}

WorldDraft draw_v(Dice& dice, double depth_m) {
  WorldDraft draft;
  const double opening_m = 1.4 + depth_m * dice.between(0.4, 1.2);
  draft.say("opening", opening_m);
  draft.add_walls({{-0.5 * opening_m, -depth_m}, {0.0, 0.0}, {0.5 * opening_m, -depth_m}});
  place_ends(draft, dice, -depth_m, 0.0);
  return draft;
}

WorldDraft draw_g(Dice& dice, double depth_m) {
  WorldDraft draft;
  const double width_m = dice.between(2.0, 3.6);
  const double height_m = std::max(depth_m, 1.2);
  const double opening_m = dice.between(0.8, 1.1);
  draft.say("width", width_m);
  draft.say("opening", opening_m);
  const double half_m = 0.5 * width_m;
  // From the opening in the side wall once around.
  draft.add_walls({{half_m, -height_m + opening_m},
                   {half_m, 0.0},
                   {-half_m, 0.0},
                   {-half_m, -height_m},
                   {half_m, -height_m}});
  draft.start = {dice.between(-0.3, 0.3) * half_m, -0.6 * height_m};
  draft.target = {dice.between(-0.5, 0.5), dice.between(0.8, 1.6)};
  return draft;
}

WorldDraft draw_recursive_u(Dice& dice, double depth_m) {
  WorldDraft draft;
  const double inner_m = dice.between(1.4, 2.2);
  const double lane_m = dice.between(0.9, 1.3);
  draft.say("inner width", inner_m);
  draft.say("lane", lane_m);
  add_u(draft, inner_m, depth_m, 0.0);
  // The outer U reaches further on one side, where the inner one's way out leads.
  const double half_m = 0.5 * inner_m + lane_m;
  draft.add_walls({{-half_m, -depth_m - dice.between(0.2, 0.6)},
                   {-half_m, lane_m},
                   {half_m, lane_m},
                   {half_m, -depth_m - dice.between(1.0, 2.0)}});
  place_ends(draft, dice, -depth_m, lane_m);
  return draft;
}

WorldDraft draw_spiral(Dice& dice, double depth_m) {
  WorldDraft draft;
  const double corridor_m = dice.between(1.0, 1.4);
  const int turns = std::min(static_cast<int>(depth_m / (1.5 * corridor_m)), 3);
  const int arms = 3 + 4 * turns;  // the last three are the left, upper and right side
  draft.say("corridor", corridor_m);
  draft.say_count("arms", arms);
  Vec2 at{-0.5 * corridor_m, -0.5 * corridor_m};
  Vec2 way{0.0, 1.0};
  std::vector<Vec2> points = {at};
  for (int arm = 0; arm < arms; ++arm) {
    const double length_m = corridor_m * static_cast<double>(1 + arm / 2);
    at += length_m * way;
    points.push_back(at);
    way = {way.y(), -way.x()};
  }
  draft.add_walls(points);
  const double top_m = corridor_m * (0.5 + static_cast<double>(turns));
  draft.target = {dice.between(-0.2, 0.2), top_m + dice.between(0.4, 1.0)};
  return draft;
}

WorldDraft draw_comb(Dice& dice, double depth_m) {
  WorldDraft draft;
  const int pockets = dice.count(3, 5);
  const double width_m = dice.between(1.0, 1.5);
  draft.say_count("pockets", pockets);
  draft.say("pocket width", width_m);
  const double half_m = 0.5 * width_m * static_cast<double>(pockets);
  draft.add_walls({{-half_m, 0.0}, {half_m, 0.0}});
  for (int tooth = 0; tooth <= pockets; ++tooth) {
    const double x_m = -half_m + width_m * static_cast<double>(tooth);
    draft.add_walls({{x_m, 0.0}, {x_m, -depth_m}});
  }
  place_ends(draft, dice, -depth_m, 0.0);
  return draft;
}

WorldDraft draw_dead_end_corridor(Dice& dice, double depth_m) {
  WorldDraft draft;
  const double width_m = dice.between(0.8, 1.3);
  draft.say("width", width_m);
  add_u(draft, width_m, depth_m, 0.0);
  place_ends(draft, dice, -depth_m, 0.0);
  draft.start.x() *= 0.3;
  return draft;
}

WorldDraft draw_concentric_loops(Dice& dice, double depth_m) {
  WorldDraft draft;
  const double lane_m = dice.between(1.0, 1.3);
  const int rings = 1 + std::min(static_cast<int>(depth_m / (1.5 * lane_m)), 3);
  draft.say("lane", lane_m);
  draft.say_count("rings", rings);
  for (int ring = 0; ring < rings; ++ring) {
    const double radius_m = lane_m * (static_cast<double>(ring) + 0.9);
    // A gap of the lane's width, away from the target on the inner ring, then in turn.
    const double gap_rad = lane_m / radius_m;
    const double middle_rad = core::kPi * (ring % 2 == 0 ? -0.5 : 0.5) + dice.between(-0.4, 0.4);
    std::vector<Vec2> points;
    for (int i = 0; i <= kRingSides; ++i) {
      const double share = static_cast<double>(i) / kRingSides;
      const double angle_rad = middle_rad + 0.5 * gap_rad + share * (2.0 * core::kPi - gap_rad);
      points.push_back(radius_m * core::direction(angle_rad));
    }
    draft.add_walls(points);
  }
  draft.target = {dice.between(-0.3, 0.3),
                  lane_m * (static_cast<double>(rings) + 0.4) + dice.between(0.4, 1.0)};
  return draft;
}

}  // namespace clew::trap_worlds
