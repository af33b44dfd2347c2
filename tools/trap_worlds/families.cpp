// SPDX-License-Identifier: Apache-2.0
#include "trap_worlds/families.hpp"

namespace clew::trap_worlds {

const std::vector<Family>& families() {
  using Claim = TrapClaim;
  static const std::vector<Family> all = {
      {"u", "U open to the start", true, Claim::kOnTheWay, draw_u},
      {"v", "V open to the start", true, Claim::kOnTheWay, draw_v},
      {"g", "chamber with one opening at the side, the robot inside", true, Claim::kOnTheWay,
       draw_g},
      {"recursive-u", "U in a U: the way out of one is a dead end of the other", true,
       Claim::kOnTheWay, draw_recursive_u},
      {"spiral", "square spiral, the robot in its centre", true, Claim::kOnTheWay, draw_spiral},
      {"comb", "row of pockets beside each other", true, Claim::kOnTheWay, draw_comb},
      {"dead-end-corridor", "narrow corridor toward the target, closed at its end", true,
       Claim::kOnTheWay, draw_dead_end_corridor},
      {"double-wall", "two walls from opposite sides, one behind the other", true, Claim::kAny,
       draw_double_wall},
      {"slits", "hollow wall with slits too narrow for the robot", true, Claim::kOnTheWay,
       draw_slits},
      {"concentric-loops", "rings around the robot, their gaps on opposite sides", true,
       Claim::kOnTheWay, draw_concentric_loops},
      {"staggered-baffles", "corridor with walls from either side in turn", true, Claim::kAny,
       draw_staggered_baffles},
      {"symmetric-wall", "straight wall met head-on at its middle", true, Claim::kAny,
       draw_symmetric_wall},
      {"look-alike", "equal niches beside an open way", true, Claim::kAny, draw_look_alike},
      {"closing-door", "wall with two doors, of which the near one closes", true, Claim::kOnTheWay,
       draw_closing_door},
      {"clutter", "round obstacles that leave no trap", true, Claim::kNone, draw_clutter},
      {"unreachable", "the target in a closed room", false, Claim::kOnTheWay, draw_unreachable},
      {"arrival-open", "target in the open", true, Claim::kFreeWay, draw_open_arrival},
      {"arrival-wall", "target beside a wall", true, Claim::kFreeWay, draw_wall_arrival},
      {"arrival-corner", "target in a corner", true, Claim::kFreeWay, draw_corner_arrival},
      {"arrival-gap", "target between two walls 0.35 m apart", true, Claim::kFreeWay,
       draw_gap_arrival},
      {"small-room", "room full of anything", true, Claim::kByChance, draw_small_room},
      {"small-closed-room", "room full of anything, without a way", false, Claim::kByChance,
       draw_small_room},
      {"rooms", "rooms with doors of 0.36 to 1 m, loops and dead ends", true, Claim::kByChance,
       draw_rooms},
      {"maze", "maze of corridors 0.9 m wide, with loops", true, Claim::kByChance, draw_maze},
      {"mix", "rooms, corridors 0.9 m wide, doors, openings and furniture", true, Claim::kByChance,
       draw_mix},
      {"crowd", "hall in which people walk to and fro", true, Claim::kByChance, draw_crowd}};
  return all;
}

}  // namespace clew::trap_worlds
