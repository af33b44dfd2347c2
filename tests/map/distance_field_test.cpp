// SPDX-License-Identifier: Apache-2.0
/// Distances and paths that are repaired are those of a new field, to the bit, and the least.
#include "map/distance_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <queue>
#include <random>

#include "map/astar.hpp"
#include "map/distance_path.hpp"

namespace clew::map {
namespace {

constexpr double kCell_m = 0.05;

Costmap open_costs(std::int32_t columns, std::int32_t rows) {
  Costmap costs;
  costs.grid = {{0.0, 0.0}, kCell_m, columns, rows};
  costs.cost.assign(costs.grid.size(), 1.0F);
  costs.clearance.assign(costs.grid.size(), Clearance::kOpen);
  costs.revision = 1;
  return costs;
}

void set(Costmap& costs, std::size_t index, float cost) {
  costs.cost[index] = cost;
  costs.changed.push_back(index);
}

/// Costs of a robot's surroundings that change at random, near a place more than elsewhere.
class RandomCosts {
 public:
  RandomCosts(std::uint64_t seed, std::int32_t columns, std::int32_t rows, int blocked_percent = 40)
      : random_(seed), blocked_percent_(blocked_percent), costs_(open_costs(columns, rows)) {
    for (std::size_t i = 0; i < costs_.cost.size(); ++i) costs_.cost[i] = any_cost();
  }

  const Costmap& costs() const { return costs_; }
  std::int32_t below(std::int32_t end) {
    return static_cast<std::int32_t>(random_() % static_cast<std::uint64_t>(end));
  }
  Cell any_cell() { return {below(costs_.grid.columns), below(costs_.grid.rows)}; }
  void change_near(const Cell& middle) {
    ++costs_.revision;
    costs_.changed.clear();
    for (int i = 0; i < 40; ++i) {
      const Cell cell{middle.column + below(9) - 4, middle.row + below(9) - 4};
      if (costs_.grid.contains(cell)) set(costs_, costs_.grid.index(cell), any_cost());
    }
    set(costs_, costs_.grid.index(any_cell()), any_cost());
  }
  /// The same cells on a grid that is larger to all sides, and lies `shift` cells farther.
  void grow(std::int32_t shift) {
    const Grid before = costs_.grid;
    std::vector<float> spare;
    costs_.grid.corner -= shift * kCell_m * Vec2(1.0, 1.0);
    costs_.grid.columns += 2 * shift;
    costs_.grid.rows += 2 * shift;
    lay_out_anew(before, costs_.grid, 1.0F, costs_.cost, spare);
    costs_.clearance.assign(costs_.grid.size(), Clearance::kOpen);
    ++costs_.revision;
    costs_.changed.clear();
  }

 private:
  float any_cost() {
    return below(100) < blocked_percent_ ? Costmap::kBlocked
                                         : 1.0F + 0.25F * static_cast<float>(below(20));
  }

  std::mt19937_64 random_;
  int blocked_percent_;
  Costmap costs_;
};

/// Blocks of two by two cells from their definition: what touches is looked up cell by cell.
class Blocks {
 public:
  explicit Blocks(const Costmap& costs)
      : costs_(costs),
        grid_{costs.grid.corner, 2.0 * kCell_m, (costs.grid.columns + 1) / 2,
              (costs.grid.rows + 1) / 2} {}

  const Grid& grid() const { return grid_; }
  bool is_free(const Cell& cell) const {
    return costs_.grid.contains(cell) && costs_.cost[costs_.grid.index(cell)] != Costmap::kBlocked;
  }
  static Cell cell_of(const Cell& block, int i) {
    return {2 * block.column + i % 2, 2 * block.row + i / 2};
  }
  /// The mean of its free cells in quarters, rounded.
  std::uint32_t weight(const Cell& block) const {
    std::uint32_t sum = 0;
    std::uint32_t count = 0;
    for (int i = 0; i < 4; ++i) {
      const Cell cell = cell_of(block, i);
      if (!is_free(cell)) continue;
      sum += static_cast<std::uint32_t>(4.0F * costs_.cost[costs_.grid.index(cell)]);
      ++count;
    }
    return (2 * sum + count) / (2 * count);
  }
  bool linked(const Cell& a, const Cell& b) const {
    for (int i = 0; i < 16; ++i) {
      const Cell one = cell_of(a, i % 4);
      const Cell two = cell_of(b, i / 4);
      if (std::abs(one.column - two.column) <= 1 && std::abs(one.row - two.row) <= 1 &&
          is_free(one) && is_free(two)) {
        return true;
      }
    }
    return false;
  }

 private:
  const Costmap& costs_;
  Grid grid_;
};

/// The least cost over blocks by Dijkstra's algorithm.
std::uint32_t least_cost(const Costmap& costs, const Cell& start, const std::vector<Cell>& goals) {
  const Blocks blocks(costs);
  const Grid& grid = blocks.grid();
  std::vector<std::uint32_t> best(grid.size(), DistanceField::kNone);
  using Entry = std::pair<std::uint32_t, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto offer = [&](std::size_t index, std::uint32_t cost) {
    if (cost >= best[index]) return;
    best[index] = cost;
    open.push({cost, index});
  };
  for (const Cell& goal : goals) {
    if (blocks.is_free(goal)) offer(grid.index({goal.column / 2, goal.row / 2}), 0);
  }
  while (!open.empty()) {
    const auto [cost, index] = open.top();
    open.pop();
    if (cost > best[index]) continue;
    const Cell here = grid.cell(index);
    for (int i = 0; i < 9; ++i) {
      const Cell near{here.column + i % 3 - 1, here.row + i / 3 - 1};
      if (near == here || !grid.contains(near) || !blocks.linked(here, near)) continue;
      const std::uint32_t length = near.column != here.column && near.row != here.row ? 17 : 12;
      offer(grid.index(near), cost + length * (blocks.weight(here) + blocks.weight(near)));
    }
  }
  return best[grid.index({start.column / 2, start.row / 2})];
}

bool is_free(const Costmap& costs, const Cell& cell) {
  return costs.cost[costs.grid.index(cell)] != Costmap::kBlocked;
}

/// A robot that wanders over costs that change around it; the goals are others now and then, and
/// the grid grows, by an odd number of cells, too.
TEST(DistanceField, RepairsToWhatANewOneComputes) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomCosts world(seed, 37, 30);
    DistanceField repaired;
    std::vector<Vec2> path;
    std::vector<Vec2> path_anew;
    std::vector<Cell> goals = {world.any_cell(), world.any_cell()};
    Cell start = world.any_cell();
    for (int step = 0; step < 60; ++step) {
      if (step % 15 == 14) goals = {world.any_cell(), world.any_cell(), world.any_cell()};
      if (step == 20 || step == 40) {
        const std::int32_t shift = step == 20 ? 4 : 3;
        world.grow(shift);
        start = {start.column + shift, start.row + shift};
        for (Cell& goal : goals) goal = {goal.column + shift, goal.row + shift};
      } else {
        world.change_near(start);
      }
      const Cell next{start.column + world.below(5) - 2, start.row + world.below(5) - 2};
      if (world.costs().grid.contains(next)) start = next;
      DistanceField anew;

      repaired.take_in(world.costs(), goals);
      anew.take_in(world.costs(), goals);
      const std::uint32_t cost = repaired.settle(start);
      const std::uint32_t cost_anew = anew.settle(start);

      ASSERT_EQ(cost, cost_anew) << seed << ' ' << step;
      if (is_free(world.costs(), start)) {
        ASSERT_EQ(cost, least_cost(world.costs(), start, goals)) << seed << ' ' << step;
      }
      if (cost == DistanceField::kNone) continue;
      ++found;
      repaired.path(world.costs(), path);
      anew.path(world.costs(), path_anew);
      ASSERT_EQ(path, path_anew) << seed << ' ' << step;
    }
  }
  EXPECT_GT(found, 300);
}

TEST(DistanceField, MovesWithItsGridToWhatANewOneComputes) {
  std::uint32_t state = 7;
  const auto below = [&](std::int32_t end) {
    state = state * 1664525U + 1013904223U;
    return static_cast<std::int32_t>((state >> 8) % static_cast<std::uint32_t>(end));
  };
  Costmap costs = open_costs(40, 37);
  costs.revision = 0;  // so that all cells are compared
  std::vector<float> spare;
  Cell shift{0, 0};  // of the grid, in cells
  DistanceField field;
  int with_path = 0;
  int outside = 0;
  for (int round = 0; round < 400; ++round) {
    if (round % 4 == 3) {
      const Grid before = costs.grid;
      shift = {2 * (below(9) - 4), 2 * (below(9) - 4)};
      costs.grid.corner = kCell_m * Vec2(shift.column, shift.row);
      costs.grid.columns = 14 + below(36);  // the goal is not always within
      costs.grid.rows = 14 + below(36);
      lay_out_anew(before, costs.grid, 1.0F, costs.cost, spare);
      costs.clearance.assign(costs.grid.size(), Clearance::kOpen);
    }
    for (int i = 0; i < 12; ++i) {
      const Cell cell{below(costs.grid.columns), below(costs.grid.rows)};
      const int drawn = below(6);
      costs.cost[costs.grid.index(cell)] = static_cast<float>(drawn);  // 0: blocked
    }
    const std::vector<Cell> goals = {{20 - shift.column, 18 - shift.row}};
    const Cell start{below(costs.grid.columns), below(costs.grid.rows)};
    DistanceField fresh;
    field.take_in(costs, goals);
    fresh.take_in(costs, goals);
    const std::uint32_t distance = fresh.settle(start);
    ASSERT_EQ(field.settle(start), distance) << "round " << round;
    outside += costs.grid.contains(goals.front()) ? 0 : 1;
    if (distance == DistanceField::kNone) continue;
    ++with_path;
    std::vector<Vec2> places;
    std::vector<Vec2> fresh_places;
    field.path(costs, places);
    fresh.path(costs, fresh_places);
    ASSERT_EQ(places, fresh_places) << "round " << round;
  }
  EXPECT_GT(with_path, 100);
  EXPECT_GT(outside, 20);
}

/// What is certainly cut on cells is cut on blocks, and nothing else: `unreachable` is a proof.
TEST(DistanceField, FindsAPathWhereCellsAreConnectedAndNowhereElse) {
  int cut = 0;
  for (std::uint64_t seed = 100; seed < 300; ++seed) {
    RandomCosts world(seed, 24, 21, 55);
    const Cell start = world.any_cell();
    const Cell goal = world.any_cell();
    if (!is_free(world.costs(), start) || !is_free(world.costs(), goal)) continue;
    const Grid& grid = world.costs().grid;
    AStar cells;
    DistancePath blocks;

    const bool on_cells =
        !cells.find(world.costs(), grid.centre(start), grid.centre(goal), 0.001).empty();
    const bool on_blocks =
        !blocks.find(world.costs(), grid.centre(start), grid.centre(goal), 0.001).empty();

    EXPECT_EQ(on_blocks, on_cells) << seed;
    cut += on_cells ? 0 : 1;
  }
  EXPECT_GT(cut, 10);
}

TEST(DistanceField, TakesInCostsWhoseChangesItHasNotSeen) {
  RandomCosts world(7, 30, 30);
  const std::vector<Cell> goals = {{29, 29}, {0, 29}};
  DistanceField repaired;
  repaired.take_in(world.costs(), goals);
  repaired.settle({15, 15});
  for (int i = 0; i < 5; ++i) world.change_near({15, 18});  // five revisions at once

  repaired.take_in(world.costs(), goals);

  DistanceField anew;
  anew.take_in(world.costs(), goals);
  EXPECT_EQ(repaired.settle({15, 15}), anew.settle({15, 15}));
}

}  // namespace
}  // namespace clew::map
