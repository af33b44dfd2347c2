// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/following/flanks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/angle.hpp"
#include "tests/recover/scene.hpp"

namespace clew::recover {
namespace {

using core::degrees;
using core::radians;

TEST(ObstacleSide, IsThatOfTheNearestReturn) {
  EXPECT_EQ(obstacle_side(Scene().sees({0.9, 1, 1, 1, 0.8, 1, 1}).situation()), Side::kRight);
  EXPECT_EQ(obstacle_side(Scene().sees({0.7, 1, 1, 1, 0.8, 1, 1}).situation()), Side::kLeft);
}

TEST(ObstacleSide, IsTheTargetsForAnObstacleStraightAhead) {
  EXPECT_EQ(obstacle_side(Scene().sees({1, 1, 1, 0.5, 1, 1, 1}).target(1, 1).situation()),
            Side::kLeft);
  EXPECT_EQ(obstacle_side(Scene().sees({1, 1, 1, 0.5, 1, 1, 1}).target(1, -1).situation()),
            Side::kRight);
}

/// Expects that a turn changes the sides of both, by the shorter way past the obstacle.
void expect_both_change_sides(double obstacle_deg, double target_deg) {
  const double turn_rad = turn_about_rad(radians(obstacle_deg), radians(target_deg));
  const double obstacle_rad = core::wrap_angle_rad(radians(obstacle_deg) - turn_rad);
  const double target_rad = core::wrap_angle_rad(radians(target_deg) - turn_rad);

  EXPECT_GT(turn_rad * obstacle_deg, 0.0) << obstacle_deg << " and " << target_deg;
  EXPECT_LT(std::fabs(turn_rad), 2.0 * core::kPi);
  EXPECT_LT(obstacle_rad * obstacle_deg, 0.0) << obstacle_deg << " and " << target_deg;
  EXPECT_LT(target_rad * target_deg, 0.0) << obstacle_deg << " and " << target_deg;
}

TEST(TurnAbout, ChangesBothSidesForEveryPairOfAngles) {
  for (int obstacle_deg = 1; obstacle_deg < 180; ++obstacle_deg) {
    for (int target_deg = 1; target_deg < 180; ++target_deg) {
      expect_both_change_sides(-obstacle_deg, target_deg);  // case iii
      expect_both_change_sides(obstacle_deg, -target_deg);  // case iv
    }
  }
}

TEST(TurnAbout, BringsTheObstacleAbeamWhereThatChangesTheTargetsSideToo) {
  EXPECT_NEAR(degrees(turn_about_rad(radians(-30.0), radians(100.0))), -120.0, 1e-9);
  EXPECT_NEAR(degrees(turn_about_rad(radians(45.0), radians(-60.0))), 135.0, 1e-9);
}

TEST(TurnAbout, GoesOnUntilTheTargetHasChangedSides) {
  // Abeam at 120 degrees; the target changes sides at 170.
  EXPECT_NEAR(degrees(turn_about_rad(radians(-30.0), radians(10.0))), -175.0, 1e-9);
}

TEST(TurnAbout, TakesTheMiddleWhereBothAreStraightAhead) {
  // The target changes sides at 178 degrees, and the obstacle changes back at 182.
  EXPECT_NEAR(degrees(turn_about_rad(radians(-2.0), radians(2.0))), -180.0, 1e-9);
}

}  // namespace
}  // namespace clew::recover
