// SPDX-License-Identifier: Apache-2.0
/// Drives whose actuators lag or slip.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/drive/drive_run.hpp"

namespace clew::drive {
namespace {

/// A drive whose actuators lag or slip.
DriveRun run_with(const ActuatorParameters& actuators) {
  return DriveRun("", true, 100, {}, {}, std::nullopt, actuators);
}

TEST(ActuatedDrive, FollowsItsCommandsLateWithLag) {
  ActuatorParameters actuators;
  actuators.lag_s = 0.3;  // a tick: a share of 1 - 1/e at once
  DriveRun run = run_with(actuators);
  run.start();
  const double share = 1.0 - std::exp(-1.0);

  const double first_m = run.step(ahead(0.1)).path_length_m;
  const double second_m = run.step(ahead(0.1)).path_length_m - first_m;
  const double third_m = run.step(ahead(0.0)).path_length_m - first_m - second_m;

  EXPECT_NEAR(first_m, share * 0.1, 1e-12);
  EXPECT_NEAR(second_m, (1.0 - std::exp(-2.0)) * 0.1, 1e-12);
  EXPECT_NEAR(third_m, std::exp(-1.0) * second_m, 1e-12);
  // Wheels that lag do not slip: odometry knows.
  EXPECT_NEAR(std::get<domain::Odometry>(run.messages()).travel_m, first_m + second_m + third_m,
              1e-12);
}

TEST(ActuatedDrive, StopsAtOnceWithLagWhenItIsToldToStop) {
  ActuatorParameters actuators;
  actuators.lag_s = 1.0;
  DriveRun run = run_with(actuators);
  run.start();
  run.step(ahead(0.1));
  const double before_m = run.step(ahead(0.1)).path_length_m;

  EXPECT_EQ(run.step({}).path_length_m, before_m);
  EXPECT_EQ(run.step(ahead(0.1), false).path_length_m, before_m);
}

TEST(ActuatedDrive, GoesLessFarThanItsWheelsWhenTheySlip) {
  ActuatorParameters actuators;
  actuators.slip.m_per_m = 0.25;
  actuators.slip.rad_per_rad = 0.5;
  DriveRun run = run_with(actuators);
  run.start();
  Motion motion = ahead(0.1);
  motion.turn_rad = 0.4;

  const domain::State& state = run.step(motion);

  EXPECT_NEAR(state.path_length_m, 0.075, 1e-12);
  EXPECT_NEAR(state.pose_world_robot.heading_rad, 0.2, 1e-12);
  const auto& odometry = std::get<domain::Odometry>(run.messages());
  EXPECT_NEAR(odometry.travel_m, 0.1, 1e-12);
  EXPECT_NEAR(odometry.pose_odom_robot.heading_rad, 0.4, 1e-12);
  // The wheels turned first: they believe that the whole way led there.
  EXPECT_NEAR(odometry.pose_odom_robot.x_m, 5.0 + 0.1 * std::cos(0.4), 1e-12);
  EXPECT_NEAR(odometry.pose_odom_robot.y_m, 5.0 + 0.1 * std::sin(0.4), 1e-12);
}

TEST(ActuatedDrive, SlipsByChanceAroundWhatItSlipsAlways) {
  ActuatorParameters actuators;
  actuators.slip.m_per_sqrt_m = 0.05;
  actuators.slip.rad_per_sqrt_m = 0.1;
  DriveRun run = run_with(actuators);
  run.start();
  double way_m = 0.0;
  double squares_rad2 = 0.0;
  double heading_rad = 0.0;
  constexpr int kTicks = 90;
  for (int i = 0; i < kTicks; ++i) {
    const domain::State& state = run.step(ahead(0.01));
    way_m = state.path_length_m;
    const double turned_rad = state.pose_world_robot.heading_rad - heading_rad;
    squares_rad2 += turned_rad * turned_rad;
    heading_rad = state.pose_world_robot.heading_rad;
  }

  // Of 0.9 m a standard deviation of 0.047 m, and of a centimetre one of 0.01 rad.
  EXPECT_NEAR(way_m, 0.9, 4 * 0.047);
  EXPECT_NE(way_m, 0.9);
  EXPECT_NEAR(std::sqrt(squares_rad2 / kTicks), 0.01, 0.003);
  EXPECT_NEAR(std::get<domain::Odometry>(run.messages()).travel_m, 0.9, 1e-9);
  EXPECT_NEAR(std::get<domain::Odometry>(run.messages()).pose_odom_robot.heading_rad, 0.0, 1e-9);
}

TEST(ActuatedDrive, TellsOfLagAndSlipOnlyWhereTheyShow) {
  const std::string said = "Its actuators lag or slip";
  ActuatorParameters lag;
  lag.lag_s = 0.5;
  ActuatorParameters slip;
  slip.slip.m_per_m = 0.2;
  slip.slip.rad_per_sqrt_m = 0.1;
  for (const ActuatorParameters& actuators : {lag, slip}) {
    DriveRun run = run_with(actuators);
    run.start();
    run.step(ahead(0.0));
    EXPECT_EQ(run.told(true).find(said), std::string::npos);
    run.step(ahead(0.1));
    EXPECT_NE(run.told(true).find(said), std::string::npos);
  }
}

TEST(ActuatedDrive, TellsHowFarSlipMayHaveLedItsOdometryAstray) {
  DriftParameters drift;
  drift.m_per_m = -0.1;
  drift.m_per_sqrt_m = 0.03;
  ActuatorParameters actuators;
  actuators.slip.m_per_m = 0.2;
  actuators.slip.rad_per_rad = 0.5;
  actuators.slip.m_per_sqrt_m = 0.04;
  DriveRun run("", true, 100, drift, {}, std::nullopt, actuators);
  run.start();
  run.step(ahead(0.1));
  const auto& odometry = std::get<domain::Odometry>(run.messages());

  // Straight on, so all is along x: sizes add up, and variances do.
  const double counted_m = odometry.travel_m;
  EXPECT_NEAR(odometry.covariance.x_m2,
              counted_m * counted_m * 0.09 + counted_m * (0.0009 + 0.0016), 1e-12);
  EXPECT_EQ(odometry.covariance.heading_rad2, 0.0);
  Motion turn = ahead(0.0);
  turn.turn_rad = 0.4;
  run.step(turn);
  EXPECT_NEAR(odometry.covariance.heading_rad2, 0.2 * 0.2, 1e-12);
}

/// A state with another number where `from` stands, at its first or its last place.
std::string with_number(const std::string& state, double from, double to, bool last) {
  std::size_t at = std::string::npos;
  for (std::size_t i = 0; i + sizeof(double) <= state.size(); ++i) {
    double value = 0.0;
    std::memcpy(&value, state.data() + i, sizeof(value));
    if (std::fabs(value - from) < 1e-12 && (last || at == std::string::npos)) at = i;
  }
  EXPECT_NE(at, std::string::npos) << from;
  std::string changed = state;
  if (at != std::string::npos) std::memcpy(changed.data() + at, &to, sizeof(to));
  return changed;
}

// Sweeping what a state of 1e300 m/s leads to would not end.
TEST(ActuatedDrive, RefusesAStateWhoseMotionNoDriveLeadsTo) {
  ActuatorParameters actuators;
  actuators.lag_s = 0.5;
  actuators.slip.m_per_sqrt_m = 0.1;
  DriveRun run = run_with(actuators);
  run.start();
  run.step(ahead(0.1));
  const std::string saved = run.saved();
  ASSERT_EQ(run.fault_of(saved), "");
  const double tick_s = 0.3;
  const double wheels_m = 0.1 * (1.0 - std::exp(-tick_s / 0.5));
  const double speed_mps = std::get<domain::State>(run.messages()).speed_mps;

  for (const double number : {HUGE_VAL, 1e300, -1e300, 1e6}) {
    EXPECT_NE(run.fault_of(with_number(saved, wheels_m, number, true))
                  .find("a motion of the wheels is one that no drive leads to"),
              std::string::npos)
        << number;
    EXPECT_NE(run.fault_of(with_number(saved, speed_mps, number, false))
                  .find("a speed of the robot is one that no drive leads to"),
              std::string::npos)
        << number;
  }
  for (const double duration_s : {-0.1, 1e-300, HUGE_VAL}) {
    EXPECT_NE(run.fault_of(with_number(saved, tick_s, duration_s, true)), "") << duration_s;
  }
  EXPECT_TRUE(std::isfinite(run.step(ahead(0.1)).pose_world_robot.x_m));
}

TEST(ActuatedDrive, GoesOnAsBeforeAfterSaveAndLoadWithLagAndSlip) {
  ActuatorParameters actuators;
  actuators.lag_s = 0.5;
  actuators.slip.m_per_m = 0.1;
  actuators.slip.rad_per_sqrt_m = 0.1;
  DriveRun run = run_with(actuators);
  run.start();
  run.step(ahead(0.1));
  DriveRun other = run_with(actuators);
  other.start();
  other.step(ahead(0.02));
  other.go_on_from(run);

  EXPECT_EQ(other.step(ahead(0.1)).pose_world_robot, run.step(ahead(0.1)).pose_world_robot);
  EXPECT_EQ(std::get<domain::Odometry>(other.messages()).pose_odom_robot,
            std::get<domain::Odometry>(run.messages()).pose_odom_robot);
}

}  // namespace
}  // namespace clew::drive
