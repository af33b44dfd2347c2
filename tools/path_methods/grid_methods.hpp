// SPDX-License-Identifier: Apache-2.0
/// What the neural map is compared with: other ways to plan on the same cells. Each fills one
/// number a cell, less the nearer the target is, infinite where nothing leads there. Cells are
/// linked to their eight neighbours.
#pragma once

#include <cstdint>
#include <vector>

#include "map/grid.hpp"

namespace clew::path_methods {

using map::Cell;
using map::Grid;
using map::Vec2;

/// What is to be planned.
struct Task {
  Grid grid;
  std::vector<std::uint8_t> passable;  ///< by Grid::index
  Cell start;
  Cell target;
};

/// Lengths of the shortest ways over cells (Dijkstra 1959, with a binary heap), in cells. Stops
/// when the start is settled, or, without `to_start`, when all cells are.
void dijkstra(const Task& task, bool to_start, std::vector<double>& lengths);

/// The distance transform (Jarvis 1985): in how many steps a wave from the target reaches a cell.
void distance_transform(const Task& task, std::vector<double>& steps);

/// A harmonic function (Connolly & Grupen 1993): 0 at the target, 1 at obstacles and at the border,
/// the mean of its four neighbours elsewhere. Solved by successive over-relaxation with the factor
/// 2 / (1 + sin(pi / n)) for a grid of n cells a side, from 1, until no cell moves by more than
/// `tolerance`. Returns the sweeps.
///
/// In double precision it is flat where the target is many corridor widths away: descent() then
/// fails.
int harmonic(const Task& task, double tolerance, std::vector<double>& potential);

/// Follows the steepest descent, per length of a step, from the start to the target. False where
/// no neighbour is lower.
bool descent(const Task& task, const std::vector<double>& heights, std::vector<Cell>& cells);

}  // namespace clew::path_methods
