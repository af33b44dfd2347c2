// SPDX-License-Identifier: Apache-2.0
#include "world_analysis/reachability.hpp"

#include <cmath>
#include <vector>

namespace clew::world_analysis {
namespace {

/// Whether a flood over the lattice, from the nodes `begins(node)` of those around the start, along
/// steps that `passes(from, to)`, comes to a node that `arrives(node)`.
template <typename Begins, typename Passes, typename Arrives>
bool flood(const ClearanceGrid& grid, const Vec2& from, const Begins& begins, const Passes& passes,
           const Arrives& arrives) {
  std::vector<bool> seen(grid.size());
  std::vector<std::size_t> open;
  const auto enter = [&](std::size_t node) {
    if (seen[node]) return;
    seen[node] = true;
    open.push_back(node);
  };
  const std::size_t start = grid.nearest(from);
  if (begins(start)) enter(start);
  grid.visit_around(start, 2, [&](std::size_t node) {
    if (begins(node)) enter(node);
  });
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    if (arrives(node)) return true;
    grid.visit_around(node, 1, [&](std::size_t next) {
      if (!seen[next] && passes(node, next)) enter(next);
    });
  }
  return false;
}

}  // namespace

Solvable is_solvable(const ClearanceGrid& grid, double radius_m, double margin_m) {
  const world::World& world = grid.world();
  const Leg whole{world.start().position(), world.target(), world.target_radius_m()};
  return is_solvable(grid, whole, radius_m, margin_m);
}

Solvable is_solvable(const ClearanceGrid& grid, const Leg& leg, double radius_m, double margin_m) {
  const Vec2 start = leg.from;
  const auto distance_m = [&](std::size_t node) {
    return core::length(grid.position(node) - leg.to);
  };

  const double with_margin_m = radius_m + margin_m;
  const bool found = flood(
      grid, start,
      [&](std::size_t node) {
        return grid.clearance_m(node) >= with_margin_m &&
               grid.is_way_free(start, grid.position(node), radius_m);
      },
      [&](std::size_t a, std::size_t b) { return grid.is_way_free(a, b, with_margin_m); },
      [&](std::size_t node) { return distance_m(node) <= leg.radius_m; });
  if (found) return Solvable::kYes;
  // What moves has come to rest over the start: the robot need not be there any more.
  if (grid.world().clearance_m(start, radius_m, grid.time_s()) < radius_m &&
      grid.world().clearance_m(start, radius_m, 0.0) >= radius_m) {
    return Solvable::kUndecided;
  }

  const double half_diagonal_m = kSpacing_m * std::sqrt(0.5);
  const double least_m = radius_m - half_diagonal_m;
  const bool possible = flood(
      grid, start,
      [&](std::size_t node) {
        return grid.clearance_m(node) >= least_m &&
               core::length(grid.position(node) - start) <= half_diagonal_m;
      },
      [&](std::size_t, std::size_t b) { return grid.clearance_m(b) >= least_m; },
      [&](std::size_t node) { return distance_m(node) <= leg.radius_m + half_diagonal_m; });
  return possible ? Solvable::kUndecided : Solvable::kNo;
}

}  // namespace clew::world_analysis
