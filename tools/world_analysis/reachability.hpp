// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "world_analysis/clearance_grid.hpp"

namespace clew::world_analysis {

/// Whether a disc gets from the start to within the target's radius. Both answers are proofs.
enum class Solvable {
  kYes,       ///< a way of straight pieces was found, each free by the exact sweep
  kNo,        ///< see is_solvable
  kUndecided  ///< only by gaps about as wide as the disc
};

/// `margin_m`: kYes asks for room for a disc that is this much larger in radius, so that a gap that
/// fits only in theory does not count as a way.
///
/// kNo: a way for the disc's centre passes cells of the lattice whose nodes are at most half a
/// diagonal away from it, and so have a clearance of at least the radius less half a diagonal; if
/// not even such nodes join start and target, there is no way. Where what moves has come to rest on
/// the start, a robot has left that, and nothing is decided.
Solvable is_solvable(const ClearanceGrid& grid, double radius_m, double margin_m);
/// The same of one leg, from its first place itself.
Solvable is_solvable(const ClearanceGrid& grid, const Leg& leg, double radius_m, double margin_m);

}  // namespace clew::world_analysis
