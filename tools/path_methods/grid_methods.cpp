// SPDX-License-Identifier: Apache-2.0
#include "path_methods/grid_methods.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "core/math.hpp"

namespace clew::path_methods {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// Calls visit(index, length of the step) for the passable neighbours of a cell.
template <typename Visit>
void visit_neighbours(const Task& task, std::size_t index, const Visit& visit) {
  const Cell cell = task.grid.cell(index);
  for (std::int32_t row = -1; row <= 1; ++row) {
    for (std::int32_t column = -1; column <= 1; ++column) {
      const Cell next{cell.column + column, cell.row + row};
      if (next == cell || !task.grid.contains(next)) continue;
      const std::size_t at = task.grid.index(next);
      if (task.passable[at] == 0) continue;
      visit(at, row != 0 && column != 0 ? std::sqrt(2.0) : 1.0);
    }
  }
}

}  // namespace

void dijkstra(const Task& task, bool to_start, std::vector<double>& lengths) {
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  lengths.assign(task.grid.size(), kFar);
  const std::size_t start = task.grid.index(task.start);
  lengths[task.grid.index(task.target)] = 0.0;
  open.emplace(0.0, static_cast<std::uint32_t>(task.grid.index(task.target)));
  while (!open.empty()) {
    const auto [length, index] = open.top();
    open.pop();
    if (length > lengths[index]) continue;
    if (to_start && index == start) return;
    visit_neighbours(task, index, [&, from = length](std::size_t next, double step) {
      if (!(from + step < lengths[next])) return;
      lengths[next] = from + step;
      open.emplace(from + step, static_cast<std::uint32_t>(next));
    });
  }
}

void distance_transform(const Task& task, std::vector<double>& steps) {
  steps.assign(task.grid.size(), kFar);
  std::vector<std::uint32_t> wave = {static_cast<std::uint32_t>(task.grid.index(task.target))};
  steps[wave.front()] = 0.0;
  for (std::size_t i = 0; i < wave.size(); ++i) {
    const double next_step = steps[wave[i]] + 1.0;
    visit_neighbours(task, wave[i], [&](std::size_t next, double) {
      if (steps[next] <= next_step) return;
      steps[next] = next_step;
      wave.push_back(static_cast<std::uint32_t>(next));
    });
  }
}

int harmonic(const Task& task, double tolerance, std::vector<double>& potential) {
  const Grid& grid = task.grid;
  potential.assign(grid.size(), 1.0);
  potential[grid.index(task.target)] = 0.0;
  const double factor = 2.0 / (1.0 + core::sin(core::kPi / std::max(grid.columns, grid.rows)));
  const auto at = [&](std::int32_t column, std::int32_t row) {
    const Cell cell{column, row};
    return grid.contains(cell) ? potential[grid.index(cell)] : 1.0;
  };
  for (int sweeps = 1;; ++sweeps) {
    double greatest = 0.0;
    for (std::int32_t row = 0; row < grid.rows; ++row) {
      for (std::int32_t column = 0; column < grid.columns; ++column) {
        const Cell cell{column, row};
        const std::size_t index = grid.index(cell);
        if (task.passable[index] == 0 || cell == task.target) continue;
        const double mean = 0.25 * (at(column - 1, row) + at(column + 1, row) +
                                    at(column, row - 1) + at(column, row + 1));
        const double change = factor * (mean - potential[index]);
        potential[index] += change;
        greatest = std::max(greatest, std::fabs(change));
      }
    }
    if (!(greatest > tolerance)) return sweeps;
  }
}

bool descent(const Task& task, const std::vector<double>& heights, std::vector<Cell>& cells) {
  cells.assign(1, task.start);
  while (cells.back() != task.target) {
    const std::size_t index = task.grid.index(cells.back());
    double steepest = 0.0;
    std::size_t best = index;
    visit_neighbours(task, index, [&](std::size_t next, double step) {
      const double fall = (heights[index] - heights[next]) / step;
      if (!(fall > steepest)) return;
      steepest = fall;
      best = next;
    });
    if (best == index) return false;
    cells.push_back(task.grid.cell(best));
  }
  return true;
}

}  // namespace clew::path_methods
