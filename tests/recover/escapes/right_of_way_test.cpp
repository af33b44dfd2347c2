// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/right_of_way.hpp"

#include <gtest/gtest.h>

#include "tests/recover/scene.hpp"

namespace clew::recover {
namespace {

domain::BehaviourSetup setup_of(std::uint32_t robot_index) {
  domain::BehaviourSetup setup;
  setup.tick_s = 0.5;
  setup.robot_index = robot_index;
  return setup;
}

/// Drives ahead for `length_m` along y = 0.
void drive(RightOfWay& escape, double length_m) {
  for (int i = 0; i <= static_cast<int>(length_m / 0.1 + 0.5); ++i) {
    escape.watch(Scene().tick(static_cast<std::uint64_t>(i)).at(0.1 * i, 0, 0).situation());
  }
}

TEST(RightOfWay, TheLowestIndexHasTheWay) {
  RightOfWay escape({}, setup_of(0));
  drive(escape, 2.0);
  const Scene scene = Scene().tick(30).at(2, 0, 0);
  escape.begin(scene.situation(), {});
  domain::Guidance guidance;
  EXPECT_EQ(escape.step(scene.situation(), guidance), EscapeStatus::kEnded);
  EXPECT_FALSE(guidance.has_override);
}

/// A robot that cannot go aside goes back along its trail to where that began, and holds there.
double held_s(std::uint32_t robot_index) {
  RightOfWay escape({}, setup_of(robot_index));
  drive(escape, 2.0);
  std::uint64_t tick = 30;
  double x_m = 2.0;
  Scene scene;
  const auto look = [&] {
    scene = Scene().tick(tick).at(x_m, 0, 180).travelled(4.0 - x_m).sees({0, 0, 0, 0, 0, 0, 0});
    return scene.situation();
  };
  escape.begin(look(), {});
  int held = 0;
  for (; tick < 1000; ++tick) {
    const Situation situation = look();
    escape.watch(situation);
    domain::Guidance guidance;
    if (escape.step(situation, guidance) != EscapeStatus::kActive) break;
    if (guidance.has_override) {
      EXPECT_EQ(guidance.override_motion.kind, domain::CommandKind::kStop);
      EXPECT_LT(x_m, 0.3);
      ++held;
    } else {
      EXPECT_TRUE(guidance.target_is_virtual);
      EXPECT_LT(guidance.target_x_m, x_m);
      x_m -= 0.1;
    }
  }
  return 0.5 * held;
}

TEST(RightOfWay, AHigherIndexGoesBackAndHoldsTheLonger) {
  const double first_s = held_s(1);
  EXPECT_NEAR(first_s, RightOfWayParameters{}.hold_s, 0.51);
  EXPECT_NEAR(held_s(3), 3.0 * first_s, 1.1);
}

/// A goal that was taken away cuts the escape off: the way to the next goal is noted again.
TEST(RightOfWay, ItsPhaseEndsWithACancelledGoal) {
  RightOfWay escape({}, setup_of(1));
  drive(escape, 1.0);
  const Scene stuck = Scene().tick(30).at(1, 0, 0);
  escape.begin(stuck.situation(), {});
  domain::Guidance guidance;
  ASSERT_EQ(escape.step(stuck.situation(), guidance), EscapeStatus::kActive);

  // Ticks 31 to 39 had no goal.
  for (int i = 0; i < 20; ++i) {
    const auto tick = static_cast<std::uint64_t>(40 + i);
    escape.watch(Scene().tick(tick).at(1, 0.1 * i, 90).situation());
  }
  const Scene again = Scene().tick(60).at(1, 1.9, 90);
  escape.begin(again.situation(), {});
  ASSERT_EQ(escape.step(again.situation(), guidance), EscapeStatus::kActive);
  EXPECT_GT(guidance.target_y_m, 1.0);  // back along the new way
}

}  // namespace
}  // namespace clew::recover
