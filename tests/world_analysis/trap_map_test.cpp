// SPDX-License-Identifier: Apache-2.0
#include "world_analysis/trap_map.hpp"

#include <cmath>

#include "small_world.hpp"

namespace clew::world_analysis {
namespace {

constexpr double kLeastDepth_m = 0.3;
// A node is at most 0.036 m from where the exact minimum or pass lies; twice that for both, and as
// much for nodes that just miss the clearance.
constexpr double kTolerance_m = 0.15;

TEST(TrapMap, AUHasOneTrapAsDeepAsItsWayOut) {
  const auto world =
      small_world("walls: [[3, 3, 3, 6], [3, 6, 7, 6], [7, 6, 7, 3]]", "[5, 2, 1.57]", "[5, 8]");
  const ClearanceGrid grid(world, 0.0);

  const TrapMap map(grid, kRadius_m, kLeastDepth_m);

  // The robot stands at the back wall, 2 + 0.15 m from the target. Every way out goes round a side
  // wall's end at (3, 3) or (7, 3), at sqrt(29) m, with 0.15 m between.
  ASSERT_EQ(map.traps().size(), 1u);
  EXPECT_NEAR(map.traps()[0].nearest_m, 2.15, kTolerance_m);
  EXPECT_NEAR(map.traps()[0].depth_m, std::sqrt(29.0) + 0.15 - 2.15, kTolerance_m);
  EXPECT_FALSE(map.traps()[0].inside_of.has_value());
}

TEST(TrapMap, TheRegionEndsAtThePass) {
  const auto world =
      small_world("walls: [[3, 3, 3, 6], [3, 6, 7, 6], [7, 6, 7, 3]]", "[5, 2, 1.57]", "[5, 8]");
  const ClearanceGrid grid(world, 0.0);

  const TrapMap map(grid, kRadius_m, kLeastDepth_m);

  EXPECT_EQ(map.trap_at({5.0, 5.8}), 0u);
  EXPECT_EQ(map.trap_at({3.5, 3.5}), 0u);
  EXPECT_EQ(map.trap_at({5.0, 2.6}), 0u);            // 5.4 m from the target, the pass at 5.53 m
  EXPECT_EQ(map.trap_at({5.0, 2.3}), std::nullopt);  // 5.7 m: free to go round either side
  EXPECT_EQ(map.trap_at({2.5, 5.0}), std::nullopt);  // beside
  EXPECT_EQ(map.trap_at({5.0, 6.5}), std::nullopt);  // behind
}

TEST(TrapMap, ARoundObstacleIsNone) {
  const auto world = small_world("circles: [[5, 5, 1.5]]", "[5, 1, 1.57]", "[5, 9]");

  EXPECT_TRUE(TrapMap(ClearanceGrid(world, 0.0), kRadius_m, kLeastDepth_m).traps().empty());
}

TEST(TrapMap, AStraightWallIsOneIfItIsLongForItsDistance) {
  const auto world = small_world("walls: [[2, 5, 8, 5]]", "[5, 1, 1.57]", "[5, 7]");
  const ClearanceGrid grid(world, 0.0);

  // From 2.15 m before the wall's middle to its end, at sqrt(3^2 + 2^2) + 0.15 m.
  const double depth_m = std::sqrt(13.0) + 0.15 - 2.15;
  const TrapMap map(grid, kRadius_m, kLeastDepth_m);
  ASSERT_EQ(map.traps().size(), 1u);
  EXPECT_NEAR(map.traps()[0].depth_m, depth_m, kTolerance_m);
  EXPECT_TRUE(TrapMap(grid, kRadius_m, depth_m + kTolerance_m).traps().empty());
}

TEST(TrapMap, ATrapInATrapIsInsideOfIt) {
  const auto world = small_world(
      "walls: [[4, 4, 4, 6], [4, 6, 6, 6], [6, 6, 6, 4], "
      "[3, 2, 3, 7], [3, 7, 7, 7], [7, 7, 7, 2]]",
      "[5, 1.5, 1.57]", "[5, 9]");
  const ClearanceGrid grid(world, 0.0);

  const TrapMap map(grid, kRadius_m, kLeastDepth_m);

  const auto inner = map.trap_at({5.0, 5.8});
  ASSERT_TRUE(inner.has_value());
  const auto outer = map.traps()[*inner].inside_of;
  ASSERT_TRUE(outer.has_value());
  EXPECT_EQ(map.trap_at({5.0, 3.5}), outer);
  EXPECT_LT(map.traps()[*outer].nearest_m, map.traps()[*inner].nearest_m);
  EXPECT_GT(map.traps()[*outer].nodes, map.traps()[*inner].nodes);
}

TEST(TrapMap, KnowsWhichTrapsTheRobotGetsInto) {
  // The U is in the start's room; the closed one between x = 8 and 10 is nobody's.
  const auto world =
      small_world("walls: [[3, 3, 3, 6], [3, 6, 7, 6], [7, 6, 7, 3], [8, 0, 8, 4], [8, 4, 10, 4]]",
                  "[5, 2, 1.57]", "[5, 8]");
  const ClearanceGrid grid(world, 0.0);

  const TrapMap map(grid, kRadius_m, kLeastDepth_m);

  ASSERT_EQ(map.traps().size(), 2u);
  EXPECT_TRUE(map.traps()[*map.trap_at({5.0, 5.8})].from_start);
  EXPECT_FALSE(map.traps()[*map.trap_at({9.0, 2.0})].from_start);
}

TEST(TrapMap, WithoutAWayToTheTargetEveryPlaceIsATrap) {
  const auto world = small_world("walls: [[0, 5, 10, 5]]", "[3, 3, 0]", "[7, 7]");

  const TrapMap map(ClearanceGrid(world, 0.0), kRadius_m, kLeastDepth_m);

  ASSERT_EQ(map.traps().size(), 1u);
  EXPECT_EQ(map.traps()[0].depth_m, Trap::kNoWayOut);
}

}  // namespace
}  // namespace clew::world_analysis
