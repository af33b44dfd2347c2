// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/local_minimum_planner.hpp"

#include <gtest/gtest.h>

#include "recover/escapes/goal_stack.hpp"
#include "tests/recover/scene.hpp"

namespace clew::recover {
namespace {

constexpr double kTick_s = 0.5;
constexpr double kRadius_m = 0.15;

struct Answer {
  EscapeStatus status = EscapeStatus::kActive;
  domain::Guidance guidance;
};

Answer step(Escape& escape, const Scene& scene) {
  Answer answer;
  answer.status = escape.step(scene.situation(), answer.guidance);
  return answer;
}

/// A wall all round, farther at the sides.
Scene enclosed() { return Scene().sees({0.6, 0.5, 0.4, 0.4, 0.4, 0.5, 0.8}); }

/// The escape, begun at the origin with the target 10 degrees to the left.
class LocalMinimumPlannerTest : public ::testing::Test {
 protected:
  LocalMinimumPlannerTest() { escape_.begin(trap_.situation(), {}); }

  Scene trap_ = enclosed().at(0, 0, -10).target(10, 0);
  LocalMinimumPlanner escape_{{}, kTick_s, kRadius_m};
};

TEST_F(LocalMinimumPlannerTest, SetsAVirtualTargetBeyondTheOutermostReturnOfTheTargetsSide) {
  const Answer answer = step(escape_, trap_);

  // ROL at 45 degrees, 0.6 m from the skin, 0.75 m from the centre; alpha 0.6 m beyond; turned by
  // RTA = 10 degrees; heading -10 degrees.
  EXPECT_EQ(answer.status, EscapeStatus::kActive);
  EXPECT_TRUE(answer.guidance.target_is_virtual);
  EXPECT_NEAR(answer.guidance.target_x_m, 1.35 * core::cos(core::radians(45.0)), 1e-12);
  EXPECT_NEAR(answer.guidance.target_y_m, 1.35 * core::sin(core::radians(45.0)), 1e-12);
}

TEST_F(LocalMinimumPlannerTest, TakesTheRightForATargetOnTheRight) {
  LocalMinimumPlanner escape({}, kTick_s, kRadius_m);
  const Scene scene = enclosed().at(0, 0, 10).target(10, 0);
  escape.begin(scene.situation(), {});

  const Answer answer = step(escape, scene);

  EXPECT_NEAR(answer.guidance.target_x_m, 1.55 * core::cos(core::radians(45.0)), 1e-12);
  EXPECT_NEAR(answer.guidance.target_y_m, -1.55 * core::sin(core::radians(45.0)), 1e-12);
}

TEST_F(LocalMinimumPlannerTest, TheNearerWallDecidesForATargetAhead) {
  LocalMinimumPlannerParameters parameters;
  parameters.ahead_rad = core::radians(15.0);
  LocalMinimumPlanner escape(parameters, kTick_s, kRadius_m);
  // It lies 10 degrees to the right, and the wall on the left is the nearer one.
  const Scene scene = enclosed().at(0, 0, 10).target(10, 0);
  escape.begin(scene.situation(), {});

  const Answer answer = step(escape, scene);

  EXPECT_NEAR(answer.guidance.target_x_m, 1.35 * core::cos(core::radians(45.0)), 1e-12);
  EXPECT_NEAR(answer.guidance.target_y_m, 1.35 * core::sin(core::radians(45.0)), 1e-12);
}

TEST_F(LocalMinimumPlannerTest, TakesTheEndOfTheOutermostBeamWhereASideHasNoReturn) {
  LocalMinimumPlanner escape({}, kTick_s, kRadius_m);
  const Scene scene = Scene().at(0, 0, 0).target(10, 0).sees({1, 1, 1, 1, 0.5, 0.5, 0.5});
  escape.begin(scene.situation(), {});

  EXPECT_NEAR(step(escape, scene).guidance.target_y_m, 1.75 * core::sin(core::radians(45.0)),
              1e-12);
}

TEST_F(LocalMinimumPlannerTest, EndsCloseToTheVirtualTarget) {
  // It lies at (0.955, 0.955).
  EXPECT_EQ(step(escape_, Scene().at(0.95, 0.6, 0)).status, EscapeStatus::kActive);
  EXPECT_EQ(step(escape_, Scene().at(0.95, 0.7, 0)).status, EscapeStatus::kEnded);
}

TEST_F(LocalMinimumPlannerTest, GoesBackToTheVirtualTargetBelow) {
  const double first_y_m = step(escape_, trap_).guidance.target_y_m;
  const Scene second = enclosed().at(-2, 0, 180).target(10, 0).pursues(0.95, 0.95);
  EXPECT_TRUE(escape_.take_up(second.situation(), {}));
  const auto above = step(escape_, second).guidance;

  const auto below = step(escape_, Scene().at(above.target_x_m, above.target_y_m, 0)).guidance;

  EXPECT_NE(above.target_y_m, first_y_m);
  EXPECT_TRUE(below.target_is_virtual);
  EXPECT_EQ(below.target_y_m, first_y_m);
}

TEST_F(LocalMinimumPlannerTest, TriesTheOtherSideAndThenGivesUpWhatIsSetTwice) {
  escape_.take_up(trap_.situation(), {});
  const auto mirrored = step(escape_, trap_).guidance;
  // ROR at -45 degrees, 0.8 m, turned the other way: -45 - 10 - 10 degrees.
  EXPECT_NEAR(mirrored.target_x_m, 1.55 * core::cos(core::radians(-65.0)), 1e-12);
  EXPECT_NEAR(mirrored.target_y_m, 1.55 * core::sin(core::radians(-65.0)), 1e-12);

  escape_.take_up(trap_.situation(), {});
  EXPECT_EQ(step(escape_, trap_).status, EscapeStatus::kActive);
  escape_.take_up(trap_.situation(), {});
  const Answer answer = step(escape_, trap_);

  EXPECT_EQ(answer.status, EscapeStatus::kFailed);
  EXPECT_EQ(answer.guidance.why, "a virtual target at the same place again");
}

TEST_F(LocalMinimumPlannerTest, DropsAVirtualTargetThatItDoesNotComeNearerTo) {
  step(escape_, Scene(trap_).tick(0));

  // 30 s are 60 ticks.
  EXPECT_EQ(step(escape_, Scene(trap_).tick(60)).status, EscapeStatus::kActive);
  const Answer answer = step(escape_, Scene(trap_).tick(61));
  EXPECT_EQ(answer.status, EscapeStatus::kFailed);
  EXPECT_EQ(answer.guidance.why, "did not come nearer to the virtual target");
}

TEST_F(LocalMinimumPlannerTest, RemembersVirtualTargetsFromOneTrapToTheNext) {
  step(escape_, Scene().at(0.95, 0.95, 0));  // reached
  escape_.begin(trap_.situation(), {});

  EXPECT_LT(step(escape_, trap_).guidance.target_y_m, 0.0);
}

TEST_F(LocalMinimumPlannerTest, GoesOnAsBeforeAfterSaveAndLoad) {
  step(escape_, trap_);
  core::StateWriter writer;
  escape_.save(writer);
  LocalMinimumPlanner restored({}, kTick_s, kRadius_m);

  core::StateReader reader(writer.bytes());
  restored.load(reader);
  escape_.take_up(trap_.situation(), {});
  restored.take_up(trap_.situation(), {});

  EXPECT_TRUE(reader.complete());
  EXPECT_EQ(step(restored, trap_).guidance.target_y_m, step(escape_, trap_).guidance.target_y_m);
}

TEST(GoalStack, GivesTheGoalBelowTimeOfItsOwn) {
  GoalStack stack(0.3, 10.0);
  stack.push({5, 0}, 0);
  stack.push({1, 0}, 0);

  const auto reached = stack.update(Scene().at(1, 0, 0).tick(100).situation());
  const auto later = stack.update(Scene().at(1, 0, 0).tick(105).situation());
  const auto last = stack.update(Scene().at(1, 0, 0).tick(116).situation());

  EXPECT_EQ(reached, GoalStack::Change::kReached);
  EXPECT_EQ(later, GoalStack::Change::kNone);
  EXPECT_EQ(last, GoalStack::Change::kDropped);
  EXPECT_TRUE(stack.empty());
}

}  // namespace
}  // namespace clew::recover
