// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "world_analysis/clearance_grid.hpp"

namespace clew::world_analysis {

/// How long the paths of the Bug algorithms get at most in a world, for a robot that knows its
/// position, feels what it touches and remembers one or two places.
///
/// Lumelsky & Stepanov 1987, "Path-planning strategies for a point mobile automaton moving amidst
/// unknown obstacles of arbitrary shape", Algorithmica 2, 403-430: with D the straight distance
/// from start to target and p_i the perimeter of obstacle i,
///
///   Bug1: D + 1.5 sum p_i     over the obstacles that meet the disc of radius D around the target
///   Bug2: D + sum n_i p_i / 2  n_i: how often the straight line from start to target crosses i
///
/// Deviation: the robot is a disc, so an obstacle's perimeter is the way of its centre around it
/// (boundary_curves), and the wall around the world is an obstacle like others. Only what bounds
/// the space that the robot can be in counts. A line that goes along an obstacle's boundary may be
/// counted as crossing it more often than it does, which makes Bug2's bound larger than need be.
struct BugBounds {
  double straight_m = 0.0;  ///< D
  double bug1_m = 0.0;
  double bug2_m = 0.0;
  std::size_t near_target = 0;  ///< obstacles in Bug1's sum
  std::size_t crossings = 0;    ///< sum of n_i
};

/// Obstacles standing as they do at the grid's time. The bounds hold whether there is a way or not.
BugBounds bug_bounds(const ClearanceGrid& grid, double radius_m);

}  // namespace clew::world_analysis
