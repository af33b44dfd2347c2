// SPDX-License-Identifier: Apache-2.0
#include "plan/world_subgoals.hpp"

#include <gtest/gtest.h>

#include "plan/seen_source.hpp"

namespace clew::plan {
namespace {

using core::Vec2;

const std::vector<Vec2> kSubgoals = {{1.0, 0.0}, {1.0, 2.0}, {3.0, 2.0}};

Subgoal step(WorldSubgoals& planner, const Vec2& robot,
             const std::vector<Vec2>& subgoals = kSubgoals) {
  SeenSource map({}, {});
  domain::Odometry odometry;
  odometry.pose_odom_robot = {robot.x(), robot.y(), 0.0};
  return planner.step({odometry, map, {5.0, 5.0}, 0.2, subgoals});
}

TEST(WorldSubgoals, LeadsFromOneToTheNextAndToTheTarget) {
  WorldSubgoals planner{{}};

  EXPECT_EQ(step(planner, {0.0, 0.0}).place, kSubgoals[0]);
  EXPECT_EQ(step(planner, {0.81, 0.0}).place, kSubgoals[1]);
  EXPECT_EQ(step(planner, {1.0, 1.81}).place, kSubgoals[2]);
  EXPECT_EQ(step(planner, {3.0, 1.9}).place, Vec2(5.0, 5.0));
  EXPECT_EQ(step(planner, {3.0, 1.9}).radius_m, 0.2);
}

TEST(WorldSubgoals, HasARadiusOfItsOwn) {
  WorldSubgoals planner{{0.5}};

  EXPECT_EQ(step(planner, {0.49, 0.0}).place, kSubgoals[0]);
  EXPECT_EQ(step(planner, {0.49, 0.0}).radius_m, 0.5);
  EXPECT_EQ(step(planner, {0.51, 0.0}).place, kSubgoals[1]);
}

TEST(WorldSubgoals, LeavesNoneOut) {
  WorldSubgoals planner{{}};

  // At the second, which comes only after the first.
  EXPECT_EQ(step(planner, {1.0, 2.0}).place, kSubgoals[0]);
  EXPECT_EQ(step(planner, {0.79, 0.0}).place, kSubgoals[0]);
}

TEST(WorldSubgoals, SteersForTheTargetWhereTheWorldGivesNone) {
  WorldSubgoals planner{{}};

  EXPECT_EQ(step(planner, {0.0, 0.0}, {}).place, Vec2(5.0, 5.0));
}

TEST(WorldSubgoals, GoesOnFromASavedState) {
  WorldSubgoals planner{{}};
  step(planner, {1.0, 0.0});
  core::StateWriter writer;
  planner.save(writer);
  WorldSubgoals restored{{}};
  core::StateReader reader(writer.bytes());

  restored.load(reader);

  ASSERT_TRUE(reader.complete());
  EXPECT_EQ(step(restored, {0.0, 0.0}).place, kSubgoals[1]);
}

}  // namespace
}  // namespace clew::plan
