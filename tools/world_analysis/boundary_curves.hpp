// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "world_analysis/clearance_grid.hpp"

namespace clew::world_analysis {

/// A closed curve that a disc's centre follows around an obstacle, the disc touching it all the
/// way.
struct BoundaryCurve {
  std::vector<Vec2> points;  ///< the last one is joined to the first
  double length_m = 0.0;
};

/// The curves that bound the free space of a disc's centre where the disc can be from the start:
/// one around each obstacle, and one along the wall around all. What is nearer to each other than
/// the disc is wide has one curve. Empty if the disc has no room at the start.
///
/// Marching squares (Lorensen & Cline 1987, in two dimensions) on the clearances of the lattice,
/// interpolated between nodes. A clearance is a distance, so a straight piece is exact, and an arc
/// is off by a share of the square of the lattice's spacing; a corner that the disc looks into is
/// cut by less than a cell. A cell whose free nodes are opposite ones is passed if the disc gets
/// straight from one to the other, by the exact sweep.
std::vector<BoundaryCurve> boundary_curves(const ClearanceGrid& grid, double radius_m);

}  // namespace clew::world_analysis
