// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "path_methods/grid_methods.hpp"
#include "path_methods/path_measures.hpp"

namespace clew::path_methods {
namespace {

// 20 x 12 cells with a wall of one cell from below, and an enclosed cell in the upper right corner.
Task walled() {
  Task task{{{0.0, 0.0}, 1.0, 20, 12}, std::vector<std::uint8_t>(240, 1), {2, 2}, {17, 2}};
  for (std::int32_t row = 0; row < 8; ++row) task.passable[task.grid.index({10, row})] = 0;
  for (const Cell& cell : {Cell{18, 11}, Cell{18, 10}, Cell{19, 10}}) {
    task.passable[task.grid.index(cell)] = 0;
  }
  return task;
}

TEST(Dijkstra, FindsTheShortestLengths) {
  const Task task = walled();
  std::vector<double> lengths;

  dijkstra(task, false, lengths);

  // Over (10, 8), the gap's first cell: 6 rows up and 8 columns, 6 rows down and 7 columns, of
  // which six steps each are diagonal: 12 sqrt(2) + 2 + 1.
  EXPECT_NEAR(lengths[task.grid.index(task.start)], 12.0 * std::sqrt(2.0) + 3.0, 1e-12);
  EXPECT_EQ(lengths[task.grid.index({19, 11})], std::numeric_limits<double>::infinity());
  std::vector<double> to_start;
  dijkstra(task, true, to_start);
  EXPECT_EQ(to_start[task.grid.index(task.start)], lengths[task.grid.index(task.start)]);
}

TEST(DistanceTransform, CountsSteps) {
  const Task task = walled();
  std::vector<double> steps;

  distance_transform(task, steps);

  EXPECT_EQ(steps[task.grid.index(task.start)], 15.0);  // 8 columns and 7 columns
  EXPECT_EQ(steps[task.grid.index({19, 11})], std::numeric_limits<double>::infinity());
}

TEST(Harmonic, IsTheMeanOfItsNeighbours) {
  const Task task = walled();
  std::vector<double> potential;

  harmonic(task, 1e-14, potential);

  for (std::int32_t row = 1; row < 11; ++row) {
    for (std::int32_t column = 1; column < 19; ++column) {
      const Cell cell{column, row};
      if (task.passable[task.grid.index(cell)] == 0 || cell == task.target) continue;
      const double mean = 0.25 * (potential[task.grid.index({column - 1, row})] +
                                  potential[task.grid.index({column + 1, row})] +
                                  potential[task.grid.index({column, row - 1})] +
                                  potential[task.grid.index({column, row + 1})]);
      EXPECT_NEAR(potential[task.grid.index(cell)], mean, 1e-13);
    }
  }
}

TEST(Descent, LeadsToTheTargetByEachMethod) {
  const Task task = walled();
  std::vector<double> lengths;
  std::vector<double> steps;
  std::vector<double> potential;
  dijkstra(task, true, lengths);
  distance_transform(task, steps);
  harmonic(task, 1e-14, potential);

  for (const auto* heights : {&lengths, &steps, &potential}) {
    std::vector<Cell> cells;
    EXPECT_TRUE(descent(task, *heights, cells));
    EXPECT_TRUE(cells.front() == task.start && cells.back() == task.target);
    for (const Cell& cell : cells) EXPECT_NE(task.passable[task.grid.index(cell)], 0);
  }
  std::vector<Cell> cells;
  EXPECT_FALSE(descent(task, std::vector<double>(240, 1.0), cells));
}

TEST(Measures, TellLengthAndTurning) {
  // A right angle after 3 m: one turn of pi / 2, wherever the points between are.
  const std::vector<core::Vec2> corner = {{0, 0}, {3, 0}, {3, 4}};

  EXPECT_DOUBLE_EQ(length_m(corner), 7.0);
  EXPECT_NEAR(squared_turning_rad2(corner, 1.0), 0.25 * core::kPi * core::kPi, 1e-12);
  EXPECT_EQ(squared_turning_rad2({{0, 0}, {0.7, 0}, {5, 0}}, 1.0), 0.0);
  // A polygon of ten turns of 9 degrees: a tenth of that.
  std::vector<core::Vec2> arc = {{0, 0}};
  for (int i = 0; i <= 10; ++i) {
    arc.emplace_back(arc.back() + core::direction(core::radians(9.0 * i)));
  }
  EXPECT_NEAR(squared_turning_rad2(arc, 1.0), 0.025 * core::kPi * core::kPi, 1e-9);
}

}  // namespace
}  // namespace clew::path_methods
