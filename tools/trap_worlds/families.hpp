// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trap_worlds/dice.hpp"
#include "trap_worlds/world_draft.hpp"

namespace clew::trap_worlds {

/// How a family's worlds relate to traps; computed for each world, not believed.
enum class TrapClaim {
  kOnTheWay,  ///< at least one, and a straight drive to the target runs into it
  kNone,      ///< no trap, however cluttered
  kAny,       ///< depends on the parameters
  kFreeWay,   ///< the straight way to the target is free: no family of traps
  kByChance   ///< whatever was drawn: no family of traps
};

/// A kind of world. `draw` draws one with everything but the depth by chance; it may come out
/// unfit, and is then drawn again with other dice.
struct Family {
  std::string name;
  std::string about;
  bool solvable = true;
  TrapClaim traps = TrapClaim::kAny;
  WorldDraft (*draw)(Dice& dice, double depth_m);
};

/// Whether a family's worlds are about traps.
inline bool is_of_traps(const Family& family) {
  return family.traps != TrapClaim::kFreeWay && family.traps != TrapClaim::kByChance;
}

/// All families, in the order of the tables; those that are not of traps last.
const std::vector<Family>& families();

// Pockets: the robot drives in, and must turn its back to the target to get out.
WorldDraft draw_u(Dice& dice, double depth_m);
WorldDraft draw_v(Dice& dice, double depth_m);
WorldDraft draw_g(Dice& dice, double depth_m);
WorldDraft draw_recursive_u(Dice& dice, double depth_m);
WorldDraft draw_spiral(Dice& dice, double depth_m);
WorldDraft draw_comb(Dice& dice, double depth_m);
WorldDraft draw_dead_end_corridor(Dice& dice, double depth_m);
WorldDraft draw_concentric_loops(Dice& dice, double depth_m);

// Walls across the way.
WorldDraft draw_double_wall(Dice& dice, double depth_m);
WorldDraft draw_slits(Dice& dice, double depth_m);
WorldDraft draw_staggered_baffles(Dice& dice, double depth_m);
WorldDraft draw_symmetric_wall(Dice& dice, double depth_m);
WorldDraft draw_closing_door(Dice& dice, double depth_m);

// What is no trap, or has no way at all.
WorldDraft draw_look_alike(Dice& dice, double depth_m);
WorldDraft draw_clutter(Dice& dice, double depth_m);
WorldDraft draw_unreachable(Dice& dice, double depth_m);

// Arrivals: nothing on the way, and the target near walls. The depth is the distance of the start
// of two worlds in four; one starts 0.2 m from the target, one within its radius.
WorldDraft draw_open_arrival(Dice& dice, double depth_m);
WorldDraft draw_wall_arrival(Dice& dice, double depth_m);
WorldDraft draw_corner_arrival(Dice& dice, double depth_m);
WorldDraft draw_gap_arrival(Dice& dice, double depth_m);

// Rooms full of anything, to be sorted by whether they can be solved. The room grows with the
// depth.
WorldDraft draw_small_room(Dice& dice, double depth_m);

// Floor plans, every room of which can be reached through doors. They grow with the depth.
WorldDraft draw_rooms(Dice& dice, double depth_m);
WorldDraft draw_maze(Dice& dice, double depth_m);
WorldDraft draw_mix(Dice& dice, double depth_m);

// Halls in which people walk from place to place for three minutes and then stand at a side wall.
// There are the more of them the greater the depth.
WorldDraft draw_crowd(Dice& dice, double depth_m);

}  // namespace clew::trap_worlds
