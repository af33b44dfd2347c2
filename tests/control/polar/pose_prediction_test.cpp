// SPDX-License-Identifier: Apache-2.0
#include "control/polar/pose_prediction.hpp"

#include <gtest/gtest.h>

namespace clew::control {
namespace {

constexpr double kTick_s = 0.1;

TEST(AlongArc, GoesStraightAndAroundAQuarterCircle) {
  const core::Pose2 straight = along_arc({1.0, 2.0, core::kPi / 2.0}, 0.5, 0.0);
  // A quarter of a circle of radius 1 m to the left: from (0, 0) to (1, 1).
  const core::Pose2 quarter = along_arc({}, core::kPi / 2.0, core::kPi / 2.0);

  EXPECT_NEAR(straight.x_m, 1.0, 1e-15);
  EXPECT_NEAR(straight.y_m, 2.5, 1e-15);
  EXPECT_NEAR(quarter.x_m, 1.0, 1e-15);
  EXPECT_NEAR(quarter.y_m, 1.0, 1e-15);
  EXPECT_NEAR(quarter.heading_rad, core::kPi / 2.0, 1e-15);
}

TEST(PosePrediction, TakesTheTickBeforeThereIsADifference) {
  PosePrediction prediction(kTick_s);
  EXPECT_EQ(prediction.cycle_s(), kTick_s);

  prediction.observe(3.0);

  EXPECT_EQ(prediction.cycle_s(), kTick_s);
}

TEST(PosePrediction, TakesTheMeanOfTheLastFiveDifferences) {
  PosePrediction prediction(kTick_s);
  // The first difference, 0.02 s, is the sixth last one, and does not count any more.
  for (const double time_s : {0.0, 0.02, 0.12, 0.22, 0.34, 0.42, 0.52}) {
    EXPECT_TRUE(prediction.observe(time_s));
  }

  EXPECT_NEAR(prediction.cycle_s(), (0.52 - 0.02) / 5.0, 1e-12);
}

TEST(PosePrediction, BeginsAnewAfterOthersSteered) {
  PosePrediction prediction(kTick_s);
  prediction.observe(0.0);
  prediction.observe(0.08);

  EXPECT_FALSE(prediction.observe(7.3));
  EXPECT_EQ(prediction.cycle_s(), kTick_s);
}

TEST(PosePrediction, MovesOnAsTheRobotDoes) {
  PosePrediction prediction(kTick_s);

  const core::Pose2 predicted = prediction.predict({1.0, 1.0, 0.0}, 0.5, 0.2);

  EXPECT_NEAR(predicted.x_m, 1.05, 1e-4);
  EXPECT_NEAR(predicted.heading_rad, 0.02, 1e-15);
}

}  // namespace
}  // namespace clew::control
