// SPDX-License-Identifier: Apache-2.0
#include "recover/registry.hpp"

#include "recover/detectors/heading_reversal.hpp"
#include "recover/detectors/landmark_revisit.hpp"
#include "recover/detectors/map_detour.hpp"
#include "recover/detectors/no_connecting_path.hpp"
#include "recover/detectors/no_progress.hpp"
#include "recover/detectors/no_safe_region.hpp"
#include "recover/detectors/none.hpp"
#include "recover/detectors/oscillation.hpp"
#include "recover/detectors/position_revisit.hpp"
#include "recover/detectors/surrounded.hpp"
#include "recover/escapes/box_filling.hpp"
#include "recover/escapes/fixed_sequence.hpp"
#include "recover/escapes/following/obstacle_following.hpp"
#include "recover/escapes/following/track_mode.hpp"
#include "recover/escapes/local_minimum_planner.hpp"
#include "recover/escapes/map_following.hpp"
#include "recover/escapes/none.hpp"
#include "recover/escapes/right_of_way.hpp"

namespace clew::recover {

runtime::Registry<TrapDetector>& detectors() {
  static const runtime::TopicSet landmark =
      runtime::TopicSet().set(index_of(domain::Topic::kLandmark));
  static runtime::Registry<TrapDetector> registry = {
      runtime::registration<TrapDetector, LandmarkRevisit>(
          "landmark_revisit",
          "the same landmark at the same place: the distant memory (Krishna & Kalra 2000, section "
          "4.3)",
          landmark),
      runtime::registration<TrapDetector, PositionRevisit>(
          "position_revisit",
          "known positions with the same heading, several in a row (Pin & Bender 1996)"),
      runtime::registration<TrapDetector, NoSafeRegion>(
          "no_safe_region", "no navigable gap toward the target (Nakhaeinia et al. 2015)"),
      runtime::registration<TrapDetector, NoConnectingPath>(
          "no_connecting_path",
          "at the end of a leg, no path in view connects to the target (Nakhaeinia et al. 2015)"),
      runtime::registration<TrapDetector, Surrounded>(
          "surrounded",
          "no path within what was seen around connects to the target (Nakhaeinia et al. 2015)"),
      runtime::registration<TrapDetector, HeadingReversal>(
          "heading_reversal",
          "a turn of 160 degrees (Huang & Lee 1992, as in Krishna & Kalra 2000, section 4.5)"),
      runtime::registration<TrapDetector, NoProgress>(
          "no_progress", "no progress within a time limit (Nav2's SimpleProgressChecker)"),
      runtime::registration<TrapDetector, Oscillation>("oscillation",
                                                       "repeated turns back at the same places"),
      runtime::registration<TrapDetector, MapDetour>(
          "known_detour", "on the local map, every path to the target first leads away from it"),
      runtime::registration<TrapDetector, NoDetector>("none", "never says trap"),
  };
  return registry;
}

runtime::Registry<Escape>& escapes() {
  static runtime::Registry<Escape> registry = {
      runtime::registration<Escape, ObstacleFollowing>(
          "obstacle_following",
          "the four cases of the distant memory's action space (Krishna & Kalra 2000, section "
          "4.3)"),
      runtime::registration<Escape, TrackMode>(
          "track_mode",
          "tracks the obstacle from the alarm on (Huang & Lee 1992, as in Krishna & Kalra 2000, "
          "section 4.5)"),
      runtime::registration<Escape, LocalMinimumPlanner>(
          "local_minimum_planner", "a stack of virtual targets (Nakhaeinia et al. 2015)"),
      runtime::registration<Escape, BoxFilling>(
          "virtual_obstacle",
          "fills the trap with virtual obstacles, and keeps a stack of goals (Pin & Bender 1996)"),
      runtime::registration<Escape, FixedSequence>(
          "fixed_sequence",
          "clear, spin, wait, back up, one after another (Nav2's default behaviour tree)"),
      runtime::registration<Escape, RememberedMap>(
          "remembered_map",
          "a path of least cost on the local map, repaired as more is seen (ours)"),
      runtime::registration<Escape, RememberedAStar>(
          "remembered_astar",
          "a path on the local map, by replanning A* (Hart, Nilsson & Raphael 1968)"),
      runtime::registration<Escape, RightOfWay>(
          "right_of_way",
          "between robots: the lower robot_index has the way, the higher one goes back and aside "
          "(ours)"),
      runtime::registration<Escape, NoEscape>("none",
                                              "ends at once; the robot goes on seeking the target"),
  };
  return registry;
}

}  // namespace clew::recover
