// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "world_analysis/clearance_grid.hpp"

namespace clew::world_analysis {

struct ShortestPath {
  double length_m = 0.0;
  std::vector<Vec2> points;  ///< from the start to the target, both included
};

/// The shortest way of a disc's centre from start to target, obstacles standing as they do at the
/// grid's time; none if the lattice has no way.
///
/// A* (Hart, Nilsson & Raphael 1968) over steps to the 16 nearest directions of the lattice, every
/// step free by the exact sweep; then the best sequence of those of its points that see each other;
/// then each point is pulled toward the line between its neighbours, again by exact sweeps.
///
/// The result is a way that exists, so it is never too short. It is too long by the corners, which
/// are rounded by a polyline instead of an arc, and where two ways around are about equally long
/// and the lattice takes the other: the shortest path over the lattice's steps is at most 2.8 %
/// longer than that over all directions. Against the lengths that the shipped worlds state, found
/// by other means, it is within 1 % (tests/world_analysis).
std::optional<ShortestPath> shortest_path(const ClearanceGrid& grid, double radius_m);
/// The same of one leg, from its first place to its second, whatever its radius.
std::optional<ShortestPath> shortest_path(const ClearanceGrid& grid, const Leg& leg,
                                          double radius_m);

}  // namespace clew::world_analysis
