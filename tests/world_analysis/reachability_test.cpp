// SPDX-License-Identifier: Apache-2.0
#include "world_analysis/reachability.hpp"

#include "small_world.hpp"

namespace clew::world_analysis {
namespace {

constexpr double kMargin_m = 0.02;

/// A wall from side to side with one gap, which a disc of 0.3 m must pass.
Solvable with_gap(double gap_m) {
  const std::string end = std::to_string(5.0 + gap_m);
  const auto world =
      small_world("walls: [[0, 5, 5, 5], [" + end + ", 5, 10, 5]]", "[3, 3, 0]", "[7, 7]");
  return is_solvable(ClearanceGrid(world, 0.0), kRadius_m, kMargin_m);
}

TEST(Reachability, AWideGapIsAWay) { EXPECT_EQ(with_gap(0.5), Solvable::kYes); }

TEST(Reachability, AGapNarrowerThanTheRobotIsNone) {
  // In the middle of it the clearance is 0.05 m; nodes of a way have 0.15 - 0.035 m.
  EXPECT_EQ(with_gap(0.1), Solvable::kNo);
}

TEST(Reachability, AGapWithinTheMarginIsUndecided) {
  // Wider than 0.30 m, less wide than 0.34 m.
  EXPECT_EQ(with_gap(0.32), Solvable::kUndecided);
}

TEST(Reachability, AThinWallIsClosed) {
  const auto world = small_world("walls: [[0, 5, 10, 5]]", "[3, 3, 0]", "[7, 7]");

  EXPECT_EQ(is_solvable(ClearanceGrid(world, 0.0), kRadius_m, kMargin_m), Solvable::kNo);
}

TEST(Reachability, MovingObstaclesCountWhereTheyStandAtTheGridsTime) {
  const auto world = small_world(
      "walls: [[0, 5, 4, 5], [5, 5, 10, 5]]\n"
      "moving: [{circle: [4.5, 6, 0.5], path: [[0, 4.5, 6], [10, 4.5, 6], [12, 4.5, 5]]}]",
      "[3, 3, 0]", "[7, 7]");

  EXPECT_EQ(settled_time_s(world), 12.0);
  EXPECT_EQ(is_solvable(ClearanceGrid(world, 0.0), kRadius_m, kMargin_m), Solvable::kYes);
  EXPECT_EQ(is_solvable(ClearanceGrid(world, 12.0), kRadius_m, kMargin_m), Solvable::kNo);
}

TEST(Reachability, WhatComesToRestOnTheStartDecidesNothing) {
  const auto world = small_world("moving: [{circle: [3, 6, 0.5], path: [[0, 3, 6], [9, 3, 3]]}]",
                                 "[3, 3, 0]", "[7, 7]");

  EXPECT_EQ(is_solvable(ClearanceGrid(world, 0.0), kRadius_m, kMargin_m), Solvable::kYes);
  EXPECT_EQ(is_solvable(ClearanceGrid(world, 9.0), kRadius_m, kMargin_m), Solvable::kUndecided);
}

TEST(Reachability, ALoopNeverSettles) {
  const auto world = small_world(
      "moving: [{circle: [5, 5, 0.5], path: [[0, 5, 5], [9, 6, 5], [18, 5, 5]], loop: true}]",
      "[3, 3, 0]", "[7, 7]");

  EXPECT_EQ(settled_time_s(world), std::nullopt);
  EXPECT_EQ(surveyed_time_s(world).error().text(), "something moves for ever");
}

world::World empty_world(const std::string& bounds) {
  return world::World::parse("format: clew-world/1\nname: empty\nbounds: " + bounds +
                                 "\nstart: [3, 3, 0]\ntarget: [7, 3]\ntarget_radius: 0.2\n",
                             "empty.yaml")
      .value();
}

TEST(Reachability, OfAWorldThatIsTooLargeForALatticeNothingIsComputed) {
  // 20001 by 20001 nodes, and 4000001 by 4000001, more than 32 bits count.
  EXPECT_EQ(surveyed_time_s(empty_world("[0, 0, 1000, 1000]")).error().text(),
            "it has 400 million places 0.05 m apart, more than the 50 million that are looked at");
  EXPECT_FALSE(fits_lattice(empty_world("[-100000, -100000, 100000, 100000]")));
  // 20001 by 2001.
  const auto long_world = empty_world("[0, 0, 1000, 100]");
  EXPECT_EQ(lattice_nodes(long_world), 20001.0 * 2001.0);
  EXPECT_EQ(surveyed_time_s(long_world).value(), 0.0);
}

}  // namespace
}  // namespace clew::world_analysis
