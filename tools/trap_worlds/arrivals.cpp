// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "core/angle.hpp"
#include "trap_worlds/families.hpp"

namespace clew::trap_worlds {
namespace {

constexpr double kWallLength_m = 6.0;
constexpr double kGap_m = 0.35;

template <std::size_t kCount>
double one_of(Dice& dice, const std::array<double, kCount>& values) {
  return values[static_cast<std::size_t>(dice.count(0, static_cast<int>(kCount) - 1))];
}

double wall_distance_m(Dice& dice) { return one_of<6>(dice, {0.155, 0.17, 0.2, 0.25, 0.35, 0.5}); }

/// The start at the distance that the dice say, in a direction (0 is up, +y) of at most `most_rad`
/// to each side; radius and heading too. All about the target, which is set.
void set_out(Dice& dice, double depth_m, double most_rad, WorldDraft& draft) {
  draft.target_radius_m = one_of<6>(dice, {0.02, 0.03, 0.05, 0.1, 0.2, 0.5});
  const int kind = dice.count(0, 3);
  const double distance_m = kind == 0   ? dice.between(0.1, 0.9) * draft.target_radius_m
                            : kind == 1 ? 0.2
                                        : depth_m;
  const double direction_rad = 0.5 * core::kPi + dice.between(-most_rad, most_rad);
  draft.start = draft.target + distance_m * core::direction(direction_rad);
  const int heading = dice.count(0, 3);
  draft.off_target_rad = heading == 0   ? 0.0
                         : heading == 1 ? core::kPi
                                        : dice.between(-core::kPi, core::kPi);
  draft.say("distance", distance_m);
  draft.say("radius", draft.target_radius_m);
}

}  // namespace

WorldDraft draw_open_arrival(Dice& dice, double depth_m) {
  WorldDraft draft;
  draft.target = {0.0, 0.0};
  set_out(dice, depth_m, core::kPi, draft);
  return draft;
}

WorldDraft draw_wall_arrival(Dice& dice, double depth_m) {
  WorldDraft draft;
  const double wall_m = wall_distance_m(dice);
  draft.say("wall", wall_m);
  draft.add_walls({{-0.5 * kWallLength_m, 0.0}, {0.5 * kWallLength_m, 0.0}});
  draft.target = {0.0, wall_m};
  set_out(dice, depth_m, 0.5 * core::kPi, draft);
  return draft;
}

WorldDraft draw_corner_arrival(Dice& dice, double depth_m) {
  WorldDraft draft;
  const double right_m = wall_distance_m(dice);
  const double below_m = wall_distance_m(dice);
  draft.say("wall", right_m);
  draft.say("other wall", below_m);
  draft.add_walls({{0.0, kWallLength_m}, {0.0, 0.0}, {kWallLength_m, 0.0}});
  draft.target = {right_m, below_m};
  set_out(dice, depth_m, 0.5 * core::kPi, draft);
  return draft;
}

WorldDraft draw_gap_arrival(Dice& dice, double depth_m) {
  WorldDraft draft;
  const double length_m = dice.between(0.3, 0.8);
  draft.say("gap", kGap_m);
  draft.say("length", length_m);
  for (const double x_m : {-0.5 * kGap_m, 0.5 * kGap_m}) {
    draft.add_walls({{x_m, -0.5 * length_m}, {x_m, 0.5 * length_m}});
  }
  draft.target = {0.0, 0.0};
  set_out(dice, depth_m, core::radians(20.0), draft);
  return draft;
}

}  // namespace clew::trap_worlds
