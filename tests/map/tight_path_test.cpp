// SPDX-License-Identifier: Apache-2.0
#include "map/tight_path.hpp"

#include <gtest/gtest.h>

#include <random>

#include "map/distance_path.hpp"

namespace clew::map {
namespace {

/// 12 by 6 cells of 1 m that cost 1.
Costmap open_costs() {
  Costmap costs;
  costs.grid = {Vec2(0.0, 0.0), 1.0, 12, 6};
  costs.cost.assign(costs.grid.size(), 1.0F);
  costs.clearance.assign(costs.grid.size(), Clearance::kOpen);
  return costs;
}

/// From cell to cell: along a row, then diagonally up.
std::vector<Vec2> bent_path() {
  std::vector<Vec2> path;
  for (int i = 0; i <= 5; ++i) path.emplace_back(0.5 + i, 0.5);
  for (int i = 1; i <= 4; ++i) path.emplace_back(5.5 + i, 0.5 + i);
  return path;
}

TEST(TightPath, GoesStraightWhereNothingIsInTheWay) {
  const Vec2 from(0.7, 0.4);
  std::vector<Vec2> corners;

  pull_tight(open_costs(), bent_path(), from, corners);

  EXPECT_EQ(corners, (std::vector<Vec2>{from, {9.5, 4.5}}));
}

TEST(TightPath, KeepsACornerAtWhatIsBlocked) {
  Costmap costs = open_costs();
  for (int column = 0; column < 5; ++column) {
    costs.cost[costs.grid.index({column, 1})] = Costmap::kBlocked;
  }
  std::vector<Vec2> corners;

  pull_tight(costs, bent_path(), {0.5, 0.5}, corners);

  ASSERT_GE(corners.size(), 3u);
  EXPECT_GE(corners[1].x(), 5.0);
  EXPECT_EQ(corners[1].y(), 0.5);
}

TEST(TightPath, DoesNotGoStraightWhereThatCostsMore) {
  Costmap costs = open_costs();
  for (int column = 2; column < 7; ++column) costs.cost[costs.grid.index({column, 1})] = 30.0F;
  costs.cost[costs.grid.index({6, 1})] = 1.0F;
  std::vector<Vec2> corners;

  pull_tight(costs, bent_path(), {0.5, 0.5}, corners);

  EXPECT_GE(corners.size(), 3u);
}

/// What lies between is not looked at cell by cell where all cells cost 1; the corners are the
/// same.
TEST(TightPath, IsTheSameWhereItPassesOverWhatIsPlain) {
  std::mt19937_64 random(5);
  const auto within = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  int bends = 0;
  for (int round = 0; round < 40; ++round) {
    SeenMap seen(0.025, 400);
    for (int wall = 0; wall < 12; ++wall) {
      const Vec2 from(within(-2.0, 8.0), within(-4.0, 4.0));
      const Vec2 step(within(-0.03, 0.03), within(-0.03, 0.03));
      for (int i = 0; i < 60; ++i) seen.mark_hit(from + i * step);
    }
    seen.mark_free(Sector({0.0, 0.0}, 1.5));
    Inflation inflation = inflation_of(0.15, 0.1, 0.025);
    inflation.seen_free_cost = 2.0;
    CostmapBuilder builder(inflation, 0.025);
    const Vec2 from(within(-1.0, 1.0), within(-1.0, 1.0));
    const Vec2 to(within(6.0, 14.0), within(-6.0, 6.0));
    Costmap costs = builder.update(seen, from, to, 1.0);
    DistancePath search;
    const std::vector<Vec2> path = search.find(costs, from, to, 0.2);
    if (path.empty()) continue;
    std::vector<Vec2> corners;
    std::vector<Vec2> one_by_one;

    pull_tight(costs, path, from, corners);
    costs.plain = {};
    pull_tight(costs, path, from, one_by_one);

    EXPECT_EQ(corners, one_by_one) << round;
    bends += static_cast<int>(corners.size()) - 2;
  }
  EXPECT_GT(bends, 40);
}

TEST(TightPath, AppendsToWhatIsThere) {
  std::vector<Vec2> corners = {{1.0, 1.0}};

  pull_tight(open_costs(), {{0.5, 0.5}}, {0.6, 0.6}, corners);

  EXPECT_EQ(corners, (std::vector<Vec2>{{1.0, 1.0}, {0.6, 0.6}, {0.5, 0.5}}));
}

}  // namespace
}  // namespace clew::map
