// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/box_filling.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/recover/scene.hpp"

namespace clew::recover {
namespace {

constexpr double kTick_s = 0.5;

void expect_box(const VirtualObstacle& box, double x_min, double y_min, double x_max,
                double y_max) {
  EXPECT_NEAR(box.x_min_m, x_min, 1e-9);
  EXPECT_NEAR(box.y_min_m, y_min, 1e-9);
  EXPECT_NEAR(box.x_max_m, x_max, 1e-9);
  EXPECT_NEAR(box.y_max_m, y_max, 1e-9);
}

TEST(VirtualBox, IsCutWhereMostIsLeft) {
  const VirtualObstacle box{0, 0, 4, 2};

  // A point near the right end: what lies left of it is largest.
  expect_box(cut_clear(box, {3, 1}, 0.5, 0.1).value(), 0, 0, 2.5, 2);
  expect_box(cut_clear(box, {6, 1}, 0.5, 0.1).value(), 0, 0, 4, 2);
  // Nothing that is a metre wide is left of a box around the point.
  EXPECT_FALSE(cut_clear({2, 0, 4, 2}, {3, 1}, 0.5, 1.0).has_value());
}

TEST(VirtualBox, IsHalvedUntilItIsGone) {
  expect_box(halved({0, 0, 4, 2}, 0.5).value(), 1, 0.5, 3, 1.5);
  EXPECT_FALSE(halved({0, 0, 4, 0.8}, 0.5).has_value());
}

TEST(VirtualBox, HasASubgoalBeyondTheSideOppositeTheGoal) {
  const VirtualObstacle box{0, 0, 4, 2};

  EXPECT_EQ(point_opposite(box, {10, 1}, 1.0), core::Vec2(-1, 1));
  EXPECT_EQ(point_opposite(box, {-10, 1}, 1.0), core::Vec2(5, 1));
  EXPECT_EQ(point_opposite(box, {2, 10}, 1.0), core::Vec2(2, -1));
  // The line to (7, 5) leaves a box of this shape through its upper side.
  EXPECT_EQ(point_opposite(box, {7, 5}, 1.0), core::Vec2(2, -1));
}

/// Has driven from (0, 0) to (4, 0) and up to (4, 2), toward a target at (10, 1).
class BoxFillingTest : public ::testing::Test {
 protected:
  BoxFillingTest() {
    for (int i = 0; i <= 40; ++i) watch(0.1 * i, 0.0);
    for (int i = 1; i <= 20; ++i) watch(4.0, 0.1 * i);
  }

  void watch(double x_m, double y_m) {
    travel_m_ += 0.1;
    escape_.watch(scene(x_m, y_m).situation());
  }
  Scene scene(double x_m, double y_m) const {
    return Scene().at(x_m, y_m, 0).target(10, 1).travelled(travel_m_);
  }
  domain::Guidance step(const Scene& scene) {
    domain::Guidance guidance;
    guidance.target_x_m = 10.0;
    guidance.target_y_m = 1.0;
    status_ = escape_.step(scene.situation(), guidance);
    return guidance;
  }
  static TrapEvidence loop(double travel_m) {
    return {EarlierVisit{0, core::Vec2::Zero(), travel_m, 0}, ""};
  }

  /// Every position given is kept, whatever the rounding of the distances between them.
  static BoxFillingParameters parameters() {
    BoxFillingParameters parameters;
    parameters.trail_spacing_m = 0.05;
    return parameters;
  }

  double travel_m_ = 0.0;
  BoxFilling escape_{parameters(), kTick_s};
  EscapeStatus status_ = EscapeStatus::kActive;
};

TEST_F(BoxFillingTest, BoundsTheWayBetweenTheTwoVisits) {
  escape_.begin(scene(4, 2).situation(), loop(4.05));

  const auto guidance = step(scene(4, 2));

  // 2 m up and 2 m along x; the target is to the right, so the subgoal is 1 m to the left.
  ASSERT_EQ(guidance.virtual_obstacles.size(), 1u);
  expect_box(guidance.virtual_obstacles[0], 2, 0, 4, 2);
  EXPECT_TRUE(guidance.target_is_virtual);
  EXPECT_NEAR(guidance.target_x_m, 1.0, 1e-9);
  EXPECT_NEAR(guidance.target_y_m, 1.0, 1e-9);
}

TEST_F(BoxFillingTest, BoundsTheLastStretchWithoutAnEarlierVisit) {
  escape_.begin(scene(4, 2).situation(), {});

  // recent_m is 3 m: 2 m up and 1 m along x.
  expect_box(step(scene(4, 2)).virtual_obstacles[0], 3, 0, 4, 2);
}

TEST_F(BoxFillingTest, KeepsTheBoxWhenTheSubgoalIsReached) {
  escape_.begin(scene(4, 2).situation(), loop(4.05));
  const auto guidance = step(scene(1.1, 1.1));

  EXPECT_EQ(status_, EscapeStatus::kActive);
  EXPECT_FALSE(guidance.target_is_virtual);
  EXPECT_EQ(guidance.target_x_m, 10.0);
  EXPECT_EQ(guidance.virtual_obstacles.size(), 1u);
}

TEST_F(BoxFillingTest, StacksAnotherGoalAtAnotherTrap) {
  escape_.begin(scene(4, 2).situation(), loop(4.05));
  for (int i = 1; i <= 10; ++i) watch(4.0, 2.0 + 0.1 * i);
  escape_.take_up(scene(4, 3).situation(), loop(0.95));

  // The new box is 0.2 m wide and 0.9 m high around (4, 2.55); the goal before lies below left.
  const auto above = step(scene(4, 3));
  const auto below = step(scene(above.target_x_m, above.target_y_m));

  EXPECT_EQ(above.virtual_obstacles.size(), 2u);
  EXPECT_NEAR(above.target_x_m, 5.1, 1e-9);
  EXPECT_NEAR(above.target_y_m, 2.55, 1e-9);
  EXPECT_NEAR(below.target_x_m, 1.0, 1e-9);
  EXPECT_TRUE(below.target_is_virtual);
}

TEST_F(BoxFillingTest, LeavesRoomAroundTheTarget) {
  for (int i = 1; i <= 60; ++i) watch(4.0 + 0.1 * i, 2.0);  // past the target, to (10, 2)
  for (int i = 1; i <= 20; ++i) watch(10.0, 2.0 - 0.1 * i);
  escape_.begin(scene(10, 0).situation(), loop(4.05));

  // The way back is from (8, 2) by (10, 2) to (10, 0); the target is at its right edge.
  expect_box(step(scene(10, 0)).virtual_obstacles[0], 8, 0, 9.5, 2);
}

TEST_F(BoxFillingTest, DropsASubgoalThatItDoesNotComeNearerTo) {
  escape_.begin(scene(4, 2).tick(0).situation(), loop(4.05));
  step(scene(4, 2).tick(0));

  EXPECT_TRUE(step(scene(4, 2).tick(60)).target_is_virtual);
  EXPECT_FALSE(step(scene(4, 2).tick(61)).target_is_virtual);
}

TEST_F(BoxFillingTest, GivesWayIfTheTargetIsNotComeNearerTo) {
  escape_.begin(scene(4, 2).tick(0).situation(), loop(4.05));
  step(scene(1, 1).tick(0));  // at the subgoal

  // 180 s are 360 ticks. The box of 2 m is halved three times, down to 0.25 m, and then removed.
  const auto before = step(scene(1, 1).tick(360));
  const auto half = step(scene(1, 1).tick(361));
  step(scene(1, 1).tick(722));
  step(scene(1, 1).tick(1083));
  const EscapeStatus still = status_;
  const auto none = step(scene(1, 1).tick(1444));

  expect_box(before.virtual_obstacles[0], 2, 0, 4, 2);
  expect_box(half.virtual_obstacles[0], 2.5, 0.5, 3.5, 1.5);
  EXPECT_EQ(still, EscapeStatus::kActive);
  EXPECT_EQ(status_, EscapeStatus::kFailed);
  EXPECT_EQ(none.why, "virtual obstacles did not help");
}

TEST_F(BoxFillingTest, FailsWhenThereIsNoRoomForAnother) {
  escape_.begin(scene(4, 2).situation(), loop(4.05));
  for (std::size_t i = 1; i < domain::kMaxVirtualObstacles; ++i) {
    escape_.take_up(scene(4, 2).situation(), loop(4.05));
  }
  step(scene(4, 2));
  const EscapeStatus before = status_;
  escape_.take_up(scene(4, 2).situation(), loop(4.05));

  EXPECT_EQ(before, EscapeStatus::kActive);
  EXPECT_EQ(step(scene(4, 2)).why, "no room for another virtual obstacle");
  EXPECT_EQ(status_, EscapeStatus::kFailed);
}

TEST(Trail, ForgetsTheOldestPoints) {
  Trail trail(0.1, 5);
  for (int i = 0; i < 10; ++i) trail.add({1.0 * i, 0.0}, i);

  expect_box(trail.bounds(0.0), 5, 0, 9, 0);
  expect_box(trail.bounds(8.0), 8, 0, 9, 0);
  expect_box(trail.bounds(100.0), 9, 0, 9, 0);
}

}  // namespace
}  // namespace clew::recover
