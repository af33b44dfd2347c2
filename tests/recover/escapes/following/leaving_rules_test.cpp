// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/following/leaving_rules.hpp"

#include <gtest/gtest.h>

#include "tests/recover/scene.hpp"

namespace clew::recover {
namespace {

constexpr double kStep_m = 0.2;

/// Starts at the origin with a target at (10, 0), hits a wall at (4, 1) and follows it.
class BoundaryMemoryTest : public ::testing::Test {
 protected:
  BoundaryMemoryTest() {
    memory_.watch(scene(0, 0).situation());
    memory_.watch(scene(4, 1).situation());
    memory_.hit(scene(4, 1).situation());
  }

  static Scene scene(double x_m, double y_m, double heading_deg = 0.0) {
    return Scene().at(x_m, y_m, heading_deg).target(10, 0);
  }
  bool leaves(LeavingRule rule, const Scene& scene, double free_m = 0.0, bool clear = false) {
    memory_.watch(scene.situation());
    return memory_.may_leave(rule, scene.situation(), free_m, clear, kStep_m);
  }

  LeavingRules memory_;
};

TEST_F(BoundaryMemoryTest, Bug2LeavesOnTheLineFromTheStartNearerToTheTarget) {
  EXPECT_FALSE(leaves(LeavingRule::kBug2, scene(6, 0.5), 0.0, true));
  EXPECT_TRUE(leaves(LeavingRule::kBug2, scene(6, -0.1), 0.0, true));
  EXPECT_FALSE(leaves(LeavingRule::kBug2, scene(6, 0.1), 0.0, false));
  EXPECT_FALSE(leaves(LeavingRule::kBug2, scene(3, -0.1), 0.0, true));
}

TEST_F(BoundaryMemoryTest, Bug2BeginsAnewWithAnotherTarget) {
  memory_.watch(Scene().at(5, 5, 0).target(5, 20).situation());
  memory_.hit(Scene().at(6, 6, 0).target(5, 20).situation());

  const Scene beside = Scene().at(5.5, 8, 0).target(5, 20);
  const Scene across = Scene().at(4.9, 8, 0).target(5, 20);
  EXPECT_FALSE(leaves(LeavingRule::kBug2, beside, 0.0, true));
  EXPECT_TRUE(leaves(LeavingRule::kBug2, across, 0.0, true));
}

TEST_F(BoundaryMemoryTest, DistBugLeavesWhereFreeSpaceLeadsNearerThanEver) {
  leaves(LeavingRule::kDistBug, scene(7, 0));  // d_min = 3

  // From (6, 0), 4 m away: free space must reach 3 m - STEP, that is 1.2 m of it.
  EXPECT_FALSE(leaves(LeavingRule::kDistBug, scene(6, 0), 1.1));
  EXPECT_TRUE(leaves(LeavingRule::kDistBug, scene(6, 0), 1.3));
}

TEST_F(BoundaryMemoryTest, DistBugLeavesWhereTheTargetIsInView) {
  leaves(LeavingRule::kDistBug, scene(9.9, 0));

  EXPECT_TRUE(leaves(LeavingRule::kDistBug, scene(9, 0), 1.0));
}

TEST_F(BoundaryMemoryTest, TangentBugLeavesWhereItReachesNearerThanTheBoundary) {
  // The wall's nearest part, straight ahead at (7.5, 0), is 2.5 m from the target.
  EXPECT_FALSE(
      leaves(LeavingRule::kTangentBug, scene(7, 0).sees({0.6, 0.55, 0.5, 0.5, 0.5, 0.55, 0.6})));
  // Free for 1 m from (6, 0) is 3 m from the target, from (7, 0) it is 2 m.
  EXPECT_FALSE(leaves(LeavingRule::kTangentBug, scene(6, 0)));
  EXPECT_TRUE(leaves(LeavingRule::kTangentBug, scene(7, 0)));
}

TEST_F(BoundaryMemoryTest, TangentBugForgetsABoundaryThatWasLeft) {
  leaves(LeavingRule::kTangentBug, scene(7, 0).sees({1, 1, 1, 0.5, 1, 1, 1}));
  EXPECT_FALSE(leaves(LeavingRule::kTangentBug, scene(6, 0)));
  memory_.leave();

  EXPECT_TRUE(leaves(LeavingRule::kTangentBug, scene(6, 0)));
}

}  // namespace
}  // namespace clew::recover
