// SPDX-License-Identifier: Apache-2.0
/// The drives that move along arcs: what they make of each kind of command.
#include <gtest/gtest.h>

#include "core/angle.hpp"
#include "drive/differential.hpp"
#include "drive/unicycle.hpp"

namespace clew::drive {
namespace {

using domain::CommandKind;
using domain::Motion;

constexpr double kTick_s = 0.1;
constexpr double kTolerance = 1e-12;

Motion velocities(double speed_mps, double turn_rate_radps) {
  Motion motion;
  motion.kind = CommandKind::kVelocities;
  motion.speed_mps = speed_mps;
  motion.turn_rate_radps = turn_rate_radps;
  return motion;
}

Motion wheels(double left_mps, double right_mps) {
  Motion motion;
  motion.kind = CommandKind::kWheelSpeeds;
  motion.left_mps = left_mps;
  motion.right_mps = right_mps;
  return motion;
}

Motion turn_and_step(double turn_rad, double step_m) {
  Motion motion;
  motion.kind = CommandKind::kTurnAndStep;
  motion.turn_rad = turn_rad;
  motion.step_m = step_m;
  return motion;
}

/// A drive's velocities in the tick, of the one leg that it makes.
Velocities of(const DriveModel& drive, const Motion& motion, const Velocities& before = {}) {
  const Legs legs = drive.legs(motion, before);
  EXPECT_EQ(legs.size(), 1u);
  EXPECT_EQ(legs[0].turn_rad, 0.0);
  EXPECT_EQ(legs[0].duration_s, kTick_s);
  return {legs[0].step_m / kTick_s, legs[0].bend_rad / kTick_s};
}

/// A unicycle that gets to its velocities at once.
Unicycle brisk() {
  UnicycleParameters parameters;
  parameters.max_acceleration_mps2 = 100.0;
  parameters.max_turn_acceleration_radps2 = 100.0;
  return {parameters, 0.3};
}

TEST(Unicycle, MovesAsCommandedWithinItsLimits) {
  const Velocities made = of(brisk(), velocities(0.4, -0.5));

  EXPECT_NEAR(made.speed_mps, 0.4, kTolerance);
  EXPECT_NEAR(made.turn_rate_radps, -0.5, kTolerance);
}

TEST(Unicycle, KeepsTheCurvatureWhereItMustBeSlower) {
  // 1.2192 m/s is twice its 24 in/s.
  const Velocities fast = of(brisk(), velocities(1.2192, 0.4));
  // 90 degrees a second is twice its turn.
  const Velocities turning = of(brisk(), velocities(0.3, core::radians(90.0)));

  EXPECT_NEAR(fast.speed_mps, 0.6096, kTolerance);
  EXPECT_NEAR(fast.turn_rate_radps, 0.2, kTolerance);
  EXPECT_NEAR(turning.speed_mps, 0.15, kTolerance);
  EXPECT_NEAR(turning.turn_rate_radps, core::radians(45.0), kTolerance);
}

TEST(Unicycle, ChangesItsVelocitiesByItsAccelerations) {
  const Unicycle drive({}, 0.3);

  const Velocities starting = of(drive, velocities(0.6, 0.7));
  const Velocities braking = of(drive, velocities(0.0, 0.0), {0.6, -0.7});

  // 0.5 m/s^2 and 90 deg/s^2 for 0.1 s.
  EXPECT_NEAR(starting.speed_mps, 0.05, kTolerance);
  EXPECT_NEAR(starting.turn_rate_radps, core::radians(9.0), kTolerance);
  EXPECT_NEAR(braking.speed_mps, 0.55, kTolerance);
  EXPECT_NEAR(braking.turn_rate_radps, -0.7 + core::radians(9.0), kTolerance);
}

TEST(Unicycle, StopsAtOnceOnStopAndOnGivingUp) {
  for (const CommandKind kind : {CommandKind::kStop, CommandKind::kGiveUp}) {
    Motion motion;
    motion.kind = kind;

    const Velocities made = of(Unicycle({}, 0.3), motion, {0.6, 0.5});

    EXPECT_EQ(made.speed_mps, 0.0);
    EXPECT_EQ(made.turn_rate_radps, 0.0);
  }
}

TEST(Unicycle, ConvertsTurnsStepsAndWheelSpeeds) {
  const Velocities stepping = of(brisk(), turn_and_step(0.02, 0.03));
  const Velocities rolling = of(brisk(), wheels(0.2, 0.3));

  EXPECT_NEAR(stepping.speed_mps, 0.3, kTolerance);  // 0.03 m in 0.1 s
  EXPECT_NEAR(stepping.turn_rate_radps, 0.2, kTolerance);
  EXPECT_NEAR(rolling.speed_mps, 0.25, kTolerance);
  EXPECT_NEAR(rolling.turn_rate_radps, 0.1 / 0.3, kTolerance);  // wheel base: the diameter
}

TEST(Unicycle, TellsItsLimits) {
  const domain::MotionLimits limits = Unicycle({}, 0.3).limits();

  EXPECT_EQ(limits.speed_mps, 0.6096);
  EXPECT_EQ(limits.turn_rate_radps, core::radians(45.0));
  EXPECT_EQ(limits.acceleration_mps2, 0.5);
  EXPECT_EQ(limits.turn_acceleration_radps2, core::radians(90.0));
}

TEST(Differential, MovesAsItsWheelsTurn) {
  const Velocities made = of(Differential({}), wheels(0.2, 0.3));

  // Eq. 1 with a base of 0.25 m.
  EXPECT_NEAR(made.speed_mps, 0.25, kTolerance);
  EXPECT_NEAR(made.turn_rate_radps, 0.1 / 0.25, kTolerance);
}

TEST(Differential, TurnsOnTheSpotWithWheelsAgainstEachOther) {
  const Velocities made = of(Differential({}), wheels(-0.1, 0.1));

  EXPECT_NEAR(made.speed_mps, 0.0, kTolerance);
  EXPECT_NEAR(made.turn_rate_radps, 0.8, kTolerance);
}

TEST(Differential, SlowsBothWheelsWhereOneIsTooFast) {
  // 1.6 m/s is twice the fastest: both are halved, which keeps the curvature.
  const Velocities made = of(Differential({}), wheels(0.8, 1.6));

  EXPECT_NEAR(made.speed_mps, 0.6, kTolerance);
  EXPECT_NEAR(made.turn_rate_radps, 0.4 / 0.25, kTolerance);
}

TEST(Differential, ConvertsVelocitiesTurnsAndSteps) {
  const Velocities moving = of(Differential({}), velocities(0.3, 0.5));
  const Velocities stepping = of(Differential({}), turn_and_step(0.02, 0.03));
  const Velocities resting = of(Differential({}), {});

  EXPECT_NEAR(moving.speed_mps, 0.3, kTolerance);
  EXPECT_NEAR(moving.turn_rate_radps, 0.5, kTolerance);
  EXPECT_NEAR(stepping.speed_mps, 0.3, kTolerance);
  EXPECT_NEAR(stepping.turn_rate_radps, 0.2, kTolerance);
  EXPECT_EQ(resting.speed_mps, 0.0);
}

TEST(Differential, TellsItsLimits) {
  const domain::MotionLimits limits = Differential({}).limits();

  EXPECT_EQ(limits.speed_mps, 0.8);
  EXPECT_NEAR(limits.turn_rate_radps, 2.0 * 0.8 / 0.25, kTolerance);
}

}  // namespace
}  // namespace clew::drive
