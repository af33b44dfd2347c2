// SPDX-License-Identifier: Apache-2.0
#include "world_analysis/severity.hpp"

#include <algorithm>

#include "world_analysis/backtrack.hpp"

namespace clew::world_analysis {

std::vector<Trap> traps_within_reach(const TrapMap& map) {
  const std::vector<Trap>& traps = map.traps();
  std::vector<std::optional<std::size_t>> kept(traps.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < traps.size(); ++i) {
    if (traps[i].from_start) kept[i] = count++;
  }
  std::vector<Trap> reached;
  for (const Trap& trap : traps) {
    if (!trap.from_start) continue;
    reached.push_back(trap);
    // One inside of another is of the same room.
    if (trap.inside_of) reached.back().inside_of = kept[*trap.inside_of];
  }
  return reached;
}

Severity severity_of(const ClearanceGrid& grid, const TrapMap& map, double radius_m) {
  Severity severity;
  const std::vector<Trap> traps = traps_within_reach(map);
  for (const Trap& trap : traps) {
    severity.deepest_m = std::max(severity.deepest_m, trap.depth_m);
    std::size_t levels = 1;
    for (auto outer = trap.inside_of; outer; outer = traps[*outer].inside_of) ++levels;
    severity.nested_pockets = std::max(severity.nested_pockets, levels);
  }
  severity.backtrack_m = necessary_backtrack_m(grid, radius_m);
  severity.bug = bug_bounds(grid, radius_m);
  return severity;
}

}  // namespace clew::world_analysis
