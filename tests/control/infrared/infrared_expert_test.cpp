// SPDX-License-Identifier: Apache-2.0
#include "control/infrared/infrared_expert.hpp"

#include <gtest/gtest.h>

#include "tests/control/infrared_scans.hpp"

namespace clew::control {
namespace {

constexpr double kFree_m = 0.8;
constexpr double kTolerance = 1e-12;

WheelSpeeds opinion(double ahead_m, double left_m, double right_m) {
  return expert_opinion({}, {ahead_m, kFree_m, left_m, right_m});
}

TEST(InfraredExpert, GoesAheadInTheOpen) {
  const WheelSpeeds speeds = opinion(kFree_m, kFree_m, kFree_m);

  EXPECT_NEAR(speeds.left_mps, 0.2, kTolerance);
  EXPECT_NEAR(speeds.right_mps, 0.2, kTolerance);
}

TEST(InfraredExpert, TurnsOnTheSpotBeforeAnObstacle) {
  // Nearness 1 at 0.1 m, (0.6 - 0.35) / 0.5 = 0.5 at 0.35 m.
  EXPECT_NEAR(opinion(0.1, kFree_m, kFree_m).left_mps, -0.3, kTolerance);
  EXPECT_NEAR(opinion(0.1, kFree_m, kFree_m).right_mps, 0.3, kTolerance);
  EXPECT_NEAR(opinion(0.35, kFree_m, kFree_m).left_mps, 0.2 - 0.5 * 0.5, kTolerance);
  EXPECT_NEAR(opinion(0.35, kFree_m, kFree_m).right_mps, 0.2 + 0.5 * 0.1, kTolerance);
}

TEST(InfraredExpert, TurnsAwayFromTheNearerSideAlone) {
  // Left 0.2 m, nearness 0.8; right 0.4 m, nearness 0.4: a difference of 0.4.
  const WheelSpeeds speeds = opinion(kFree_m, 0.2, 0.4);
  const WheelSpeeds mirrored = opinion(kFree_m, 0.4, 0.2);

  EXPECT_NEAR(speeds.left_mps, 0.2 + 0.3 * 0.4, kTolerance);
  EXPECT_NEAR(speeds.right_mps, 0.2, kTolerance);
  EXPECT_EQ(mirrored.right_mps, speeds.left_mps);
  EXPECT_EQ(mirrored.left_mps, speeds.right_mps);
}

TEST(InfraredExpert, IsAControllerWithATargetTerm) {
  domain::BehaviourSetup setup;
  setup.scan = infrared_layout();
  const auto expert = InfraredExpert::create({}, setup);
  ASSERT_TRUE(expert.ok()) << expert.error().text();

  const domain::Motion motion =
      (*expert)->step({}, infrared_scan(kFree_m, kFree_m, kFree_m, kFree_m), core::Vec2(5, 0));

  EXPECT_EQ(motion.kind, domain::CommandKind::kWheelSpeeds);
  EXPECT_NEAR(motion.left_mps, 0.2 + 0.3, kTolerance);
  EXPECT_NEAR(motion.right_mps, 0.2 + 0.3, kTolerance);
}

}  // namespace
}  // namespace clew::control
