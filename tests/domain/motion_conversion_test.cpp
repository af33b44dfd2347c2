// SPDX-License-Identifier: Apache-2.0
#include "domain/motion_conversion.hpp"

#include <gtest/gtest.h>

namespace clew::domain {
namespace {

constexpr double kTick_s = 0.5;
constexpr double kWheelBase_m = 0.25;

Motion turn_and_step(double turn_rad, double step_m) {
  Motion motion;
  motion.kind = CommandKind::kTurnAndStep;
  motion.turn_rad = turn_rad;
  motion.step_m = step_m;
  return motion;
}

Motion velocities(double speed_mps, double turn_rate_radps) {
  Motion motion;
  motion.kind = CommandKind::kVelocities;
  motion.speed_mps = speed_mps;
  motion.turn_rate_radps = turn_rate_radps;
  return motion;
}

Motion wheel_speeds(double left_mps, double right_mps) {
  Motion motion;
  motion.kind = CommandKind::kWheelSpeeds;
  motion.left_mps = left_mps;
  motion.right_mps = right_mps;
  return motion;
}

Motion resting(CommandKind kind) {
  Motion motion;
  motion.kind = kind;
  return motion;
}

TEST(ToVelocities, DividesATurnAndAStepByTheTick) {
  const Velocities found = to_velocities(turn_and_step(-0.25, 0.125), kTick_s, kWheelBase_m);

  EXPECT_EQ(found.speed_mps, 0.25);
  EXPECT_EQ(found.turn_rate_radps, -0.5);
}

TEST(ToVelocities, TakesMeanAndDifferenceOfWheelSpeeds) {
  const Velocities found = to_velocities(wheel_speeds(0.125, 0.375), kTick_s, kWheelBase_m);

  EXPECT_EQ(found.speed_mps, 0.25);       // (0.125 + 0.375) / 2
  EXPECT_EQ(found.turn_rate_radps, 1.0);  // (0.375 - 0.125) / 0.25: to the left
}

TEST(ToVelocities, LeavesVelocitiesAsTheyAre) {
  const Velocities found = to_velocities(velocities(0.3, -0.7), kTick_s, kWheelBase_m);

  EXPECT_EQ(found.speed_mps, 0.3);
  EXPECT_EQ(found.turn_rate_radps, -0.7);
}

TEST(ToVelocities, AreZeroForStoppingAndGivingUp) {
  for (const CommandKind kind : {CommandKind::kStop, CommandKind::kGiveUp}) {
    const Velocities found = to_velocities(resting(kind), kTick_s, kWheelBase_m);

    EXPECT_EQ(found.speed_mps, 0.0);
    EXPECT_EQ(found.turn_rate_radps, 0.0);
  }
}

TEST(ToTurnAndStep, IsWhatTheVelocitiesMakeInATick) {
  for (const Motion& motion : {velocities(0.25, 1.0), wheel_speeds(0.125, 0.375)}) {
    const Motion found = to_turn_and_step(motion, kTick_s, kWheelBase_m);

    EXPECT_EQ(found.kind, CommandKind::kTurnAndStep);
    EXPECT_EQ(found.step_m, 0.125);
    EXPECT_EQ(found.turn_rad, 0.5);
  }
}

TEST(ToTurnAndStep, LeavesATurnAndAStepAsTheyAre) {
  const Motion found = to_turn_and_step(turn_and_step(0.1, 0.7), kTick_s, kWheelBase_m);

  EXPECT_EQ(found.turn_rad, 0.1);
  EXPECT_EQ(found.step_m, 0.7);
}

TEST(ToTurnAndStep, IsNeitherForStoppingAndGivingUp) {
  for (const CommandKind kind : {CommandKind::kStop, CommandKind::kGiveUp}) {
    const Motion found = to_turn_and_step(resting(kind), kTick_s, kWheelBase_m);

    EXPECT_EQ(found.kind, CommandKind::kTurnAndStep);
    EXPECT_EQ(found.turn_rad, 0.0);
    EXPECT_EQ(found.step_m, 0.0);
  }
}

}  // namespace
}  // namespace clew::domain
