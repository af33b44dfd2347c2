// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "world_analysis/clearance_grid.hpp"

namespace clew::world_analysis {

/// How far a robot must lead away from the target before it can come nearer, on the best of all
/// ways from the start: the least b such that some way to the target is nowhere more than b farther
/// from it than it was before. None if the lattice has no way.
///
/// A trap's depth is what getting out of it takes; this is what even a robot with a map cannot
/// avoid. So it is 0 where the way leads around a trap, and up to the trap's depth for one that
/// starts inside. To within a millimetre on the lattice, whose steps are 5 cm; less than a cell's
/// diagonal is 0.
///
/// For a given b the best way to a place is the one that has so far kept its nearest distance the
/// largest, since that leaves the most room to rise. So a search in the order of that value
/// (Dijkstra 1959, for the widest path) tells whether b is enough, and b is found by bisection.
std::optional<double> necessary_backtrack_m(const ClearanceGrid& grid, double radius_m);

}  // namespace clew::world_analysis
