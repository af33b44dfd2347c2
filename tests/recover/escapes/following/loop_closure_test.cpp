// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/following/loop_closure.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clew::recover {
namespace {

constexpr double kSamePlace_m = 0.4;
constexpr double kStep_m = 0.1;
constexpr double kCircleRadius_m = 2.0;

struct Round {
  std::optional<LoopResult> result;
  double travel_m = 0.0;
  double nearest_clear_m = 0.0;
};

/// Goes round the origin once or twice on a circle of 2 m, counter-clockwise or not, with the wall
/// on a side and the target at a place.
Round go_round(bool counter_clockwise, Side wall, const core::Vec2& target, bool clear = false,
               double radius_m = kCircleRadius_m) {
  LoopClosure circuit(kSamePlace_m);
  const double direction = counter_clockwise ? 1.0 : -1.0;
  Round round;
  for (double travel_m = 0.0; travel_m < 30.0; travel_m += kStep_m) {
    const double angle_rad = direction * travel_m / radius_m;
    const core::Pose2 pose{radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad),
                           core::wrap_angle_rad(angle_rad + direction * 0.5 * core::kPi)};
    if (travel_m == 0.0) {
      circuit.begin(pose, 0.0, target);
      continue;
    }
    round.result = circuit.add(pose, travel_m, target, clear, wall);
    round.travel_m = travel_m;
    round.nearest_clear_m = circuit.nearest_clear_m();
    if (round.result) return round;
  }
  return round;
}

TEST(LoopClosure, AroundAnObstacleThatHoldsTheTargetSeparates) {
  // The wall is on the left, inside the circle.
  EXPECT_EQ(go_round(true, Side::kLeft, {0.5, 0}).result, LoopResult::kSeparates);
  EXPECT_EQ(go_round(false, Side::kRight, {0.5, 0}).result, LoopResult::kSeparates);
}

TEST(LoopClosure, AroundAnObstacleThatDoesNotHoldTheTargetIsOpen) {
  EXPECT_EQ(go_round(true, Side::kLeft, {9, 0}).result, LoopResult::kOpen);
}

TEST(LoopClosure, InsideAWallThatShutsTheTargetOutSeparates) {
  // The wall is on the right, outside the circle.
  EXPECT_EQ(go_round(true, Side::kRight, {9, 0}).result, LoopResult::kSeparates);
  EXPECT_EQ(go_round(false, Side::kLeft, {9, 0}).result, LoopResult::kSeparates);
}

TEST(LoopClosure, InsideAWallThatHoldsTheTargetTooIsOpen) {
  EXPECT_EQ(go_round(true, Side::kRight, {0.5, 0}).result, LoopResult::kOpen);
}

TEST(LoopClosure, RoundASmallPostTheRobotIsNeverFarAway) {
  // 0.35 m from its middle: at most 0.7 m from where it began, and 0.8 m are elsewhere. The heading
  // is the same after 300 degrees, the place is near then.
  const Round post = go_round(true, Side::kLeft, {9, 0}, false, 0.35);
  EXPECT_EQ(post.result, LoopResult::kOpen);
  EXPECT_NEAR(post.travel_m, 0.35 * core::radians(300.0), 0.11);
  EXPECT_EQ(go_round(true, Side::kLeft, {0.1, 0}, false, 0.35).result, LoopResult::kSeparates);
}

TEST(LoopClosure, TurningOnTheSpotIsNoCircuit) {
  LoopClosure circuit(kSamePlace_m);
  circuit.begin({1.0, 2.0, 0.0}, 5.0, {9, 0});
  for (int tick = 1; tick < 100; ++tick) {
    const core::Pose2 pose{1.0, 2.0, core::wrap_angle_rad(0.3 * tick)};
    EXPECT_FALSE(circuit.add(pose, 5.0, {9, 0}, true, Side::kLeft).has_value());
  }
}

TEST(LoopClosure, IsNoticedThoughItIsLongerThanTheFirstHorizon) {
  // 12.6 m round, and the place to come back to moves on after 10 m: closed 12.6 m after that.
  EXPECT_NEAR(go_round(true, Side::kLeft, {9, 0}).travel_m, 10.0 + 4.0 * core::kPi, 0.6);
}

TEST(LoopClosure, KnowsTheNearestPlaceWithAClearWay) {
  EXPECT_NEAR(go_round(true, Side::kLeft, {9, 0}, true).nearest_clear_m, 7.0, 0.01);
  EXPECT_TRUE(std::isinf(go_round(true, Side::kLeft, {9, 0}, false).nearest_clear_m));
}

TEST(LoopClosure, IsNotClosedByTurningOnTheSpotOrByComingBackTheOtherWay) {
  LoopClosure circuit(kSamePlace_m);
  circuit.begin({0, 0, 0}, 0.0, {9, 0});

  for (int i = 0; i < 24; ++i) {
    const double heading_rad = core::wrap_angle_rad(core::radians(15.0 * i));
    EXPECT_FALSE(circuit.add({0, 0, heading_rad}, 0.0, {9, 0}, false, Side::kLeft).has_value());
  }
  for (int i = 0; i < 40; ++i) {
    const double x_m = i < 20 ? 0.1 * i : 0.1 * (40 - i);
    const double heading_rad = i < 20 ? 0.0 : core::kPi;
    EXPECT_FALSE(
        circuit.add({x_m, 0, heading_rad}, 0.1 * i, {9, 0}, false, Side::kLeft).has_value());
  }
}

}  // namespace
}  // namespace clew::recover
