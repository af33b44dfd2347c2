// SPDX-License-Identifier: Apache-2.0
/// A*, repaired distances and the neural map as searches over what a robot knows.
#include <gtest/gtest.h>

#include <memory>
#include <queue>
#include <random>

#include "map/astar.hpp"
#include "map/costmap.hpp"
#include "map/distance_path.hpp"
#include "map/neural_path.hpp"

namespace clew::map {
namespace {

constexpr double kCell_m = 0.025;

std::unique_ptr<PathSearch> neural_way() {
  return std::make_unique<NeuralPath>(NeuralMap::create({}).value());
}

Costmap open_grid(std::int32_t columns, std::int32_t rows) {
  Costmap costs;
  costs.grid = {{0.0, 0.0}, 1.0, columns, rows};
  costs.cost.assign(costs.grid.size(), 1.0F);
  costs.clearance.assign(costs.grid.size(), Clearance::kOpen);
  return costs;
}

void close(Costmap& costs, const Cell& cell) {
  costs.cost[costs.grid.index(cell)] = Costmap::kBlocked;
  costs.clearance[costs.grid.index(cell)] = Clearance::kNone;
}

double cost_of(const Costmap& costs, const std::vector<Vec2>& way) {
  double sum = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const double mean = 0.5 * (costs.cost[costs.grid.index(*costs.grid.cell_at(way[i - 1]))] +
                               costs.cost[costs.grid.index(*costs.grid.cell_at(way[i]))]);
    sum += mean * core::length(way[i] - way[i - 1]);
  }
  return sum;
}

/// Least cost by Bellman's equation, repeated until nothing changes; infinite where there is none.
double least_cost(const Costmap& costs, const Cell& from, const Cell& to) {
  const Grid& grid = costs.grid;
  std::vector<double> best(grid.size(), HUGE_VAL);
  best[grid.index(from)] = 0.0;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (costs.cost[i] == Costmap::kBlocked) continue;
      const Cell here = grid.cell(i);
      for (std::int32_t rows = -1; rows <= 1; ++rows) {
        for (std::int32_t columns = -1; columns <= 1; ++columns) {
          const Cell near{here.column + columns, here.row + rows};
          if (!grid.contains(near)) continue;
          const double step = std::sqrt(columns * columns + rows * rows);
          const double offered =
              best[grid.index(near)] + 0.5 * step * (costs.cost[i] + costs.cost[grid.index(near)]);
          if (offered < best[i] - 1e-9) {
            best[i] = offered;
            changed = true;
          }
        }
      }
    }
  }
  return best[grid.index(to)];
}

TEST(AStar, FindsTheLeastCost) {
  std::mt19937 dice(7);
  AStar search;
  int found = 0;
  for (int round = 0; round < 30; ++round) {
    Costmap costs = open_grid(20, 15);
    for (std::size_t i = 1; i + 1 < costs.cost.size(); ++i) {
      if (dice() % 10 < 3) {
        close(costs, costs.grid.cell(i));
      } else {
        costs.cost[i] = static_cast<float>(1 + dice() % 5);
      }
    }

    const auto& way = search.find(costs, {0.5, 0.5}, {19.5, 14.5}, 0.1);

    const double expected = least_cost(costs, {0, 0}, {19, 14});
    if (way.empty()) {
      EXPECT_EQ(expected, HUGE_VAL);
    } else {
      ++found;
      EXPECT_NEAR(cost_of(costs, way), expected, 1e-3);  // costs are summed as floats
    }
  }
  EXPECT_GT(found, 10);
}

struct Kind {
  const char* name;
  std::unique_ptr<PathSearch> (*make)();
};

/// What every search must do.
class WaySearchTest : public ::testing::TestWithParam<Kind> {
 protected:
  std::unique_ptr<PathSearch> search_ = GetParam().make();
};

TEST_P(WaySearchTest, LeadsThroughTheOnlyGapFromCellToNeighbour) {
  Costmap costs = open_grid(21, 11);
  for (std::int32_t row = 0; row < 11; ++row) {
    if (row != 9) close(costs, {10, row});
  }

  const auto& way = search_->find(costs, {2.5, 2.5}, {18.5, 2.5}, 0.1);

  ASSERT_FALSE(way.empty());
  EXPECT_EQ(way.front(), Vec2(2.5, 2.5));
  EXPECT_EQ(way.back(), Vec2(18.5, 2.5));
  bool through = false;
  for (std::size_t i = 1; i < way.size(); ++i) {
    // Of blocks of two by two cells, from the one end to the other.
    EXPECT_LE(core::length(way[i] - way[i - 1]), 4.3);
    EXPECT_NE(costs.clearance[costs.grid.index(*costs.grid.cell_at(way[i]))], Clearance::kNone);
    through = through || way[i] == Vec2(10.5, 9.5);
  }
  EXPECT_TRUE(through);
}

TEST_P(WaySearchTest, FindsNothingBehindAClosedWall) {
  Costmap costs = open_grid(21, 11);
  for (std::int32_t row = 0; row < 11; ++row) close(costs, {10, row});

  EXPECT_TRUE(search_->find(costs, {2.5, 2.5}, {18.5, 2.5}, 0.1).empty());
}

TEST_P(WaySearchTest, GoesThroughSuspectedObstaclesOnlyWhereNothingElseIsLeft) {
  Costmap costs = open_grid(21, 11);
  for (std::int32_t row = 0; row < 11; ++row) {
    for (std::int32_t column = 8; column <= 11; ++column) {
      if (row == 8 || row == 9) continue;
      costs.clearance[costs.grid.index({column, row})] = Clearance::kSuspected;
      costs.cost[costs.grid.index({column, row})] = 20.0F;
    }
  }

  const std::vector<Vec2> round = search_->find(costs, {2.5, 2.5}, {18.5, 2.5}, 0.1);
  for (const std::int32_t row : {8, 9}) close(costs, {10, row});
  const std::vector<Vec2> across = search_->find(costs, {2.5, 2.5}, {18.5, 2.5}, 0.1);

  const auto suspects = [&](const std::vector<Vec2>& way) {
    int count = 0;
    for (const Vec2& place : way) {
      count +=
          costs.clearance[costs.grid.index(*costs.grid.cell_at(place))] == Clearance::kSuspected;
    }
    return count;
  };
  ASSERT_FALSE(round.empty());
  EXPECT_EQ(suspects(round), 0);
  EXPECT_GE(suspects(across), 1);
}

TEST_P(WaySearchTest, FindsTheSameAgainAfterOtherSearches) {
  const Costmap costs = open_grid(21, 11);
  const std::vector<Vec2> first = search_->find(costs, {2.5, 2.5}, {18.5, 7.5}, 0.1);

  search_->find(open_grid(9, 30), {0.5, 0.5}, {8.5, 28.5}, 0.1);

  EXPECT_EQ(search_->find(costs, {2.5, 2.5}, {18.5, 7.5}, 0.1), first);
}

TEST_P(WaySearchTest, CrossesWhatTouchesAWallAndDoesNotGoAlongIt) {
  // The wall's only hole, at row 9, is believed to touch, and so is all along the wall, two deep.
  Costmap costs = open_grid(21, 21);
  for (std::int32_t row = 0; row < 21; ++row) {
    for (std::int32_t column = 8; column <= 12; ++column) {
      costs.clearance[costs.grid.index({column, row})] = Clearance::kTouching;
      costs.cost[costs.grid.index({column, row})] = 40.0F;
    }
    if (row != 9) close(costs, {10, row});
  }

  const auto& way = search_->find(costs, {7.5, 18.5}, {18.5, 9.5}, 0.1);

  ASSERT_FALSE(way.empty());
  int touching = 0;
  for (const Vec2& place : way) {
    touching +=
        costs.clearance[costs.grid.index(*costs.grid.cell_at(place))] == Clearance::kTouching;
  }
  EXPECT_GE(touching, 2);
  EXPECT_LE(touching, 5);
}

// The first step of a robot that stands beside a wall leads away from it, and not along it.
TEST(NeuralPath, LeavesTheTouchingCellsThatTheRobotStandsIn) {
  Costmap costs = open_grid(21, 21);
  for (std::int32_t column = 0; column < 21; ++column) {
    close(costs, {column, 0});
    for (std::int32_t row = 1; row <= 2; ++row) {
      costs.clearance[costs.grid.index({column, row})] = Clearance::kTouching;
      costs.cost[costs.grid.index({column, row})] = 40.0F;
    }
  }

  const std::vector<Vec2> way = neural_way()->find(costs, {2.5, 1.5}, {18.5, 4.5}, 0.1);

  ASSERT_GT(way.size(), 3u);
  EXPECT_EQ(way[1].y(), 2.5);
  EXPECT_EQ(way[2].y(), 3.5);
}

INSTANTIATE_TEST_SUITE_P(
    All, WaySearchTest,
    ::testing::Values(
        Kind{"AStar", [] { return std::unique_ptr<PathSearch>(std::make_unique<AStar>()); }},
        Kind{"DistancePath",
             [] { return std::unique_ptr<PathSearch>(std::make_unique<DistancePath>()); }},
        Kind{"NeuralPath", neural_way}),
    [](const auto& test) { return test.param.name; });

TEST(CostmapBuilder, TellsRoomByTheDistanceToHitsAndSuspicions) {
  SeenMap seen(kCell_m, 100);
  const Vec2 hit(1.0125, 1.0125);  // the middle of a cell
  const Vec2 suspected(3.0125, 1.0125);
  seen.mark_hit(hit);
  seen.mark_suspected(suspected);
  Inflation inflation;
  inflation.impossible_m = 0.08;
  inflation.touching_m = 0.15;
  CostmapBuilder clearance(inflation, kCell_m);

  const Costmap& costs = clearance.update(seen, {0.5, 0.5}, {3.5, 2.5}, 0.5);

  ASSERT_TRUE(costs.grid.cell_at({0.1, 0.1}).has_value());
  for (std::size_t i = 0; i < costs.grid.size(); ++i) {
    const Vec2 middle = costs.grid.centre(costs.grid.cell(i));
    const double hit_m = core::length(middle - hit);
    const double suspected_m = core::length(middle - suspected);
    // Distances are kept in steps of 2.5 mm: none of these is nearer to a border than that.
    const Clearance expected = hit_m < 0.08                         ? Clearance::kNone
                               : hit_m < 0.15                       ? Clearance::kTouching
                               : suspected_m < 0.15                 ? Clearance::kSuspected
                               : std::min(hit_m, suspected_m) < 0.2 ? Clearance::kNarrow
                                                                    : Clearance::kOpen;
    if (std::fabs(hit_m - 0.08) < 0.0025 || std::fabs(hit_m - 0.15) < 0.0025 ||
        std::fabs(suspected_m - 0.15) < 0.0025 || std::fabs(hit_m - 0.2) < 0.0025 ||
        std::fabs(suspected_m - 0.2) < 0.0025) {
      continue;
    }
    EXPECT_EQ(costs.clearance[i], expected) << middle.transpose();
    EXPECT_EQ(costs.cost[i] == Costmap::kBlocked, expected == Clearance::kNone);
    if (expected == Clearance::kSuspected) {
      EXPECT_EQ(costs.cost[i], 8.0F);
    }
    if (hit_m > 0.3 && suspected_m > 0.3) {
      EXPECT_EQ(costs.cost[i], 1.0F);
    }
  }
}

}  // namespace
}  // namespace clew::map
