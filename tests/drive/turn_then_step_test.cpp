// SPDX-License-Identifier: Apache-2.0
#include "drive/turn_then_step.hpp"

#include <gtest/gtest.h>

namespace clew::drive {
namespace {

using domain::CommandKind;
using domain::Motion;

constexpr double kWheelBase_m = 0.3;

Leg leg_of(const Motion& motion, const TurnThenStepParameters& parameters = {}) {
  const Legs legs = TurnThenStep(parameters, kWheelBase_m).legs(motion, {});
  EXPECT_EQ(legs.size(), 1u);
  return legs[0];
}

TEST(TurnThenStep, TurnsAndStepsAsCommanded) {
  Motion motion;
  motion.kind = CommandKind::kTurnAndStep;
  motion.turn_rad = 0.2;
  motion.step_m = 0.1;

  const Leg leg = leg_of(motion);

  EXPECT_EQ(leg.turn_rad, 0.2);
  EXPECT_EQ(leg.step_m, 0.1);
  EXPECT_EQ(leg.duration_s, 0.3);
}

TEST(TurnThenStep, KeepsToItsLimits) {
  Motion motion;
  motion.kind = CommandKind::kTurnAndStep;
  motion.turn_rad = -4.0;
  motion.step_m = 1.0;
  TurnThenStepParameters parameters;
  parameters.max_turn_rad = core::radians(30.0);

  const Leg leg = leg_of(motion, parameters);

  EXPECT_EQ(leg.turn_rad, -core::radians(30.0));
  EXPECT_EQ(leg.step_m, 0.15);
}

TEST(TurnThenStep, DoesNotDriveBackwards) {
  Motion motion;
  motion.kind = CommandKind::kTurnAndStep;
  motion.step_m = -0.1;

  EXPECT_EQ(leg_of(motion).step_m, 0.0);
}

TEST(TurnThenStep, ConvertsVelocities) {
  Motion motion;
  motion.kind = CommandKind::kVelocities;
  motion.speed_mps = 0.4;
  motion.turn_rate_radps = -0.5;

  const Leg leg = leg_of(motion);

  EXPECT_NEAR(leg.step_m, 0.12, 1e-12);     // 0.4 m/s for 0.3 s
  EXPECT_NEAR(leg.turn_rad, -0.15, 1e-12);  // -0.5 rad/s for 0.3 s
}

TEST(TurnThenStep, ConvertsWheelSpeeds) {
  Motion motion;
  motion.kind = CommandKind::kWheelSpeeds;
  motion.left_mps = 0.2;
  motion.right_mps = 0.3;

  const Leg leg = leg_of(motion);

  EXPECT_NEAR(leg.step_m, 0.075, 1e-12);  // 0.25 m/s for 0.3 s
  EXPECT_NEAR(leg.turn_rad, 0.1, 1e-12);  // 0.1 m/s over a base of 0.3 m, for 0.3 s
}

TEST(TurnThenStep, RestsOnStopAndOnGivingUp) {
  for (const CommandKind kind : {CommandKind::kStop, CommandKind::kGiveUp}) {
    Motion motion;
    motion.kind = kind;

    const Leg leg = leg_of(motion);

    EXPECT_EQ(leg.turn_rad, 0.0);
    EXPECT_EQ(leg.step_m, 0.0);
  }
}

}  // namespace
}  // namespace clew::drive
