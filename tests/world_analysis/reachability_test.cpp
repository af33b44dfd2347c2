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

TEST(Reachability, ALoopNeverSettles) {
  const auto world = small_world(
      "moving: [{circle: [5, 5, 0.5], path: [[0, 5, 5], [9, 6, 5], [18, 5, 5]], loop: true}]",
      "[3, 3, 0]", "[7, 7]");

  EXPECT_EQ(settled_time_s(world), std::nullopt);
}

}  // namespace
}  // namespace clew::world_analysis
