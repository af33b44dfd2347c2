// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "world_analysis/bug_bounds.hpp"
#include "world_analysis/trap_map.hpp"

namespace clew::world_analysis {

/// How hard a world's traps are for a robot that comes from the start.
struct Severity {
  double deepest_m = 0.0;  ///< of the traps it can get into; 0 without any, or Trap::kNoWayOut
  std::size_t nested_pockets = 0;     ///< traps that lie one in the other, at most; 1: side by side
  std::optional<double> backtrack_m;  ///< necessary_backtrack_m
  BugBounds bug;
};

/// Those of a map's traps that the robot can get into, such as none of a room that is closed.
std::vector<Trap> traps_within_reach(const TrapMap& map);

/// `map` is of the same grid and the same radius.
Severity severity_of(const ClearanceGrid& grid, const TrapMap& map, double radius_m);

}  // namespace clew::world_analysis
