// SPDX-License-Identifier: Apache-2.0
/// Costs that are repaired are those that a new builder computes, to the bit.
#include "map/costmap.hpp"

#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "map/distance_path.hpp"

namespace clew::map {
namespace {

constexpr double kCell_m = 0.025;
constexpr double kMargin_m = 1.0;

Inflation inflation() {
  Inflation inflation = inflation_of(0.15, 0.1, kCell_m);
  inflation.seen_free_cost = 2.0;
  inflation.suspected_cost = 20.0;
  return inflation;
}

/// What a robot might see next, at random.
class RandomSights {
 public:
  explicit RandomSights(std::uint64_t seed) : random_(seed) {}

  double within(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }
  Vec2 place_near(const Vec2& middle, double reach_m) {
    return middle + Vec2(within(-reach_m, reach_m), within(-reach_m, reach_m));
  }
  void look(const Vec2& from, SeenMap& seen) {
    for (int i = 0; i < 3; ++i) {
      seen.mark_free(Sector(from, within(0.2, 2.0), within(-3.0, 3.0), within(0.1, 3.0)));
    }
    for (int i = 0; i < 20; ++i) seen.mark_hit(place_near(from, 2.5));
    for (int i = 0; i < 40; ++i) seen.mark_suspected(place_near(from, 2.5));
  }

 private:
  std::mt19937_64 random_;
};

void expect_same(const Costmap& found, const Costmap& expected, int step) {
  ASSERT_EQ(found.grid.corner, expected.grid.corner) << step;
  ASSERT_EQ(found.grid.columns, expected.grid.columns) << step;
  ASSERT_EQ(found.grid.rows, expected.grid.rows) << step;
  ASSERT_EQ(found.cost, expected.cost) << step;
  ASSERT_EQ(found.clearance, expected.clearance) << step;
}

/// Whether all cells in the block of 8 by 8 and in those around it cost 1, looked up one by one.
bool is_plain_around(const Costmap& costs, const Cell& cell) {
  constexpr std::int32_t kSide = PlainBlocks::kSide;
  const Cell first{cell.column / kSide * kSide - kSide, cell.row / kSide * kSide - kSide};
  for (std::int32_t row = first.row; row < first.row + 3 * kSide; ++row) {
    for (std::int32_t column = first.column; column < first.column + 3 * kSide; ++column) {
      if (!costs.grid.contains({column, row})) continue;
      if (costs.cost[costs.grid.index({column, row})] != 1.0F) return false;
    }
  }
  return true;
}

/// Looks at one cell in each block; how many are plain around.
int expect_plain_where_all_cost_1(const Costmap& costs, int step) {
  int plain = 0;
  for (std::int32_t row = step % 8; row < costs.grid.rows; row += PlainBlocks::kSide) {
    for (std::int32_t column = step % 8; column < costs.grid.columns;
         column += PlainBlocks::kSide) {
      const bool expected = is_plain_around(costs, {column, row});
      EXPECT_EQ(costs.plain.is_plain_around(column, row), expected) << step;
      plain += expected ? 1 : 0;
    }
  }
  return plain;
}

/// A robot that wanders, and a target that is elsewhere now and then. With a short reach, the grid
/// does not hold all that was seen, and its borders cut tiles.
void wander(std::uint64_t seed, double reach_m) {
  RandomSights sights(seed);
  SeenMap seen(kCell_m, 400);
  CostmapBuilder repaired(inflation(), kCell_m);
  Vec2 robot(0.0, 0.0);
  Vec2 target(4.0, 1.0);
  int plain = 0;
  for (int step = 0; step < 60; ++step) {
    if (step % 20 == 19) target = sights.place_near(robot, 6.0);
    if (step == 40) seen.restore({});
    robot = sights.place_near(robot, 0.6);
    sights.look(robot, seen);

    const Costmap& found = repaired.update(seen, robot, target, kMargin_m, reach_m);

    CostmapBuilder anew(inflation(), kCell_m);
    expect_same(found, anew.update(seen, robot, target, kMargin_m, reach_m), step);
    repaired.overrule(found.grid.index(*found.grid.cell_at(robot)), 7.0F, Clearance::kTouching);
    repaired.overrule(static_cast<std::size_t>(step), Costmap::kBlocked, Clearance::kNone);
    plain += expect_plain_where_all_cost_1(found, step);
  }
  EXPECT_GT(plain, 60);
}

TEST(CostmapBuilder, RepairsToWhatANewOneComputes) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) wander(seed, 40.0);
}

TEST(CostmapBuilder, RepairsWhereTheGridCutsWhatWasSeen) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) wander(seed, 1.0);
}

TEST(CostmapBuilder, TakesInAnotherMapThatItIsGiven) {
  RandomSights sights(7);
  SeenMap first(kCell_m, 400);
  SeenMap second(kCell_m, 400);
  sights.look({0.0, 0.0}, first);
  sights.look({0.3, 0.2}, second);
  CostmapBuilder repaired(inflation(), kCell_m);
  repaired.update(first, {0.0, 0.0}, {2.0, 0.0}, kMargin_m);

  const Costmap& found = repaired.update(second, {0.3, 0.2}, {2.0, 0.0}, kMargin_m);

  CostmapBuilder anew(inflation(), kCell_m);
  expect_same(found, anew.update(second, {0.3, 0.2}, {2.0, 0.0}, kMargin_m), 0);
}

/// Such a place comes from a state that somebody made up, or from odometry that jumps.
TEST(CostmapBuilder, LeavesOutWhatMakesTheGridTooLarge) {
  RandomSights sights(5);
  SeenMap seen(kCell_m, 400);
  sights.look({0.0, 0.0}, seen);
  CostmapBuilder builder(inflation(), kCell_m);
  CostmapBuilder anew(inflation(), kCell_m);
  const Costmap& expected = anew.update(seen, {0.0, 0.0}, {2.0, 0.0}, kMargin_m);

  for (const Vec2& far : {Vec2(3000.0, 3000.0), Vec2(-1e7, 1e7), Vec2(1e9, 1e9)}) {
    SeenMap wide = seen;
    wide.mark_hit(far);
    expect_same(builder.update(wide, {0.0, 0.0}, {2.0, 0.0}, kMargin_m), expected, 0);
  }
}

/// Costs in a ring by row and column, as a grid without one holds them.
Costmap in_rows(const Costmap& ring) {
  Costmap costs;
  const Grid& grid = ring.grid;
  costs.grid = {grid.corner, grid.cell_m, grid.columns, grid.rows};
  for (std::size_t i = 0; i < costs.grid.size(); ++i) {
    const std::size_t place = grid.index(costs.grid.cell(i));
    costs.cost.push_back(ring.cost[place]);
    costs.clearance.push_back(ring.clearance[place]);
  }
  return costs;
}

/// A robot that goes far, and turns back, with the grid of its surroundings in a ring: costs, plain
/// blocks and paths are those of a new builder, search and rows. Returns how many paths there were,
/// and how often the grid moved on.
std::pair<int, int> go_far(std::uint64_t seed, double reach_m) {
  RandomSights sights(seed);
  SeenMap seen(kCell_m, 4000);
  CostmapBuilder ring(inflation(), kCell_m, CostmapBuilder::Places::kInRing);
  DistancePath repaired;
  Vec2 robot(0.3, 0.2);
  Vec2 ahead(0.8, 0.3);
  Vec2 target(9.0, 4.0);
  int paths = 0;
  int moves = 0;
  Grid before;
  for (int step = 0; step < 60; ++step) {
    if (step % 20 == 19) {
      ahead = sights.place_near({0.0, 0.0}, 0.8);
      target = robot + 8.0 * ahead;
    }
    if (step == 45) seen.restore(SeenMap::State(seen.state()));
    robot += ahead;
    if (step % 3 != 1) seen.begin_round();
    sights.look(robot, seen);
    const Costmap& found = ring.update(seen, robot, target, kMargin_m, reach_m);
    moves += shares_places(before, found.grid) && before != found.grid ? 1 : 0;
    before = found.grid;
    CostmapBuilder anew(inflation(), kCell_m);
    const Costmap& expected = anew.update(seen, robot, target, kMargin_m, reach_m);
    expect_same(in_rows(found), expected, step);
    if (step % 6 == 0) expect_plain_where_all_cost_1(found, step);
    DistancePath fresh;
    const auto& path = repaired.find(found, robot, target, 0.2);
    EXPECT_EQ(path, fresh.find(expected, robot, target, 0.2)) << seed << ' ' << step;
    paths += path.empty() ? 0 : 1;
    ring.overrule(found.grid.index({step, step}), Costmap::kBlocked, Clearance::kNone);
  }
  return {paths, moves};
}

TEST(CostmapBuilder, FollowsARobotThatGoesFarInARing) {
  int paths = 0;
  int moves = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto [some_paths, some_moves] = go_far(seed, seed % 2 == 0 ? 4.0 : 40.0);
    paths += some_paths;
    moves += some_moves;
  }
  EXPECT_GT(paths, 60);
  EXPECT_GT(moves, 60);
}

/// Every hit within reach, looked at one by one.
TEST(CostmapBuilder, KeepsTheDistanceToTheNearestHit) {
  RandomSights sights(3);
  SeenMap seen(kCell_m, 400);
  CostmapBuilder repaired(inflation(), kCell_m);
  for (int step = 0; step < 10; ++step) {
    sights.look({0.1 * step, 0.0}, seen);
    repaired.update(seen, {0.1 * step, 0.0}, {2.0, 1.0}, kMargin_m);
  }

  const Costmap& costs = repaired.update(seen, {0.9, 0.0}, {2.0, 1.0}, kMargin_m);

  for (std::size_t i = 0; i < costs.grid.size(); ++i) {
    const Vec2 middle = costs.grid.centre(costs.grid.cell(i));
    double nearest_m = HUGE_VAL;
    seen.for_each(
        Mark::kHit, middle - Vec2(1.0, 1.0), middle + Vec2(1.0, 1.0),
        [&](const Vec2& hit) { nearest_m = std::min(nearest_m, core::length(hit - middle)); });
    // Distances are kept in steps of 2.5 mm.
    if (nearest_m < inflation().impossible_m - 0.0025) {
      EXPECT_EQ(costs.clearance[i], Clearance::kNone) << middle.transpose();
    } else if (nearest_m > inflation().impossible_m + 0.0025) {
      EXPECT_NE(costs.clearance[i], Clearance::kNone) << middle.transpose();
    }
  }
}

}  // namespace
}  // namespace clew::map
