// SPDX-License-Identifier: Apache-2.0
#include "drive/drive_component.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "tests/drive/drive_run.hpp"

namespace clew::drive {
namespace {

using domain::Outcome;

TEST(DriveComponent, LeadsToTheWaypointsOfTheWorldAndEndsAtTheTarget) {
  DriveRun run("waypoints: [[5.5, 5, 0.1], [5.8, 5]]");
  run.start();
  const auto& target = std::get<domain::Target>(run.messages());
  EXPECT_EQ(target.position(), core::Vec2(5.5, 5.0));
  EXPECT_EQ(target.radius_m, 0.1);

  // A step is 0.15 m at most: 5.3 m is short of the first, 5.45 m is not; 5.57 m is short of the
  // second, whose radius is the world's 0.2 m, and 5.67 m is not.
  run.step(ahead(0.15));
  run.step(ahead(0.15));
  EXPECT_EQ(target.position(), core::Vec2(5.5, 5.0));
  EXPECT_EQ(run.step(ahead(0.15)).outcome, Outcome::kRunning);
  EXPECT_EQ(target.position(), core::Vec2(5.8, 5.0));
  EXPECT_EQ(target.radius_m, 0.2);
  run.step(ahead(0.12));
  EXPECT_EQ(target.position(), core::Vec2(5.8, 5.0));
  EXPECT_EQ(run.step(ahead(0.1)).outcome, Outcome::kRunning);
  EXPECT_EQ(target.position(), core::Vec2(6.0, 5.0));
  EXPECT_EQ(run.step(ahead(0.15)).outcome, Outcome::kReached);
}

TEST(DriveComponent, WaitsWithoutAMission) {
  DriveRun run("", true, 100, {}, {}, world::Goals{});
  run.start();

  const auto& state = run.step(ahead(0.5));

  EXPECT_EQ(state.pose_world_robot.x_m, 5.0);
  EXPECT_EQ(state.outcome, Outcome::kRunning);
  EXPECT_FALSE(state.command_late);
  EXPECT_EQ(std::get<domain::Target>(run.messages()).position(), core::Vec2(5.0, 5.0));
}

TEST(DriveComponent, ArrivesWithinTheWorldsRadiusOrItsOwn) {
  DriveRun by_world;
  DriveRun by_inch("", true, 100, {}, {0.0254});
  by_world.start();
  by_inch.start();

  // The target is 1 m ahead: at 0.75 m, 0.1 m short of it, and 0.02 m short.
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(by_world.step(ahead(0.15)).outcome, Outcome::kRunning);
    by_inch.step(ahead(0.15));
  }
  EXPECT_EQ(by_world.step(ahead(0.15)).outcome, Outcome::kReached);
  EXPECT_EQ(by_inch.step(ahead(0.15)).outcome, Outcome::kRunning);
  EXPECT_EQ(by_inch.step(ahead(0.08)).outcome, Outcome::kReached);
  EXPECT_EQ(std::get<domain::Target>(by_inch.messages()).radius_m, 0.0254);
}

TEST(DriveComponent, StartsWhereTheWorldSays) {
  DriveRun run;

  const domain::State& state = run.start();

  EXPECT_EQ(state.pose_world_robot, (core::Pose2{5, 5, 0}));
  EXPECT_EQ(state.outcome, Outcome::kRunning);
  EXPECT_FALSE(state.command_late);
  const auto& target = std::get<domain::Target>(run.messages());
  EXPECT_EQ(target.position(), core::Vec2(6, 5));
  EXPECT_EQ(target.radius_m, 0.2);
}

TEST(DriveComponent, AppliesTheCommandOfTheTickBefore) {
  DriveRun run;
  run.start();

  const domain::State& state = run.step(ahead(0.1));

  EXPECT_NEAR(state.pose_world_robot.x_m, 5.1, 1e-12);
  const auto& odometry = std::get<domain::Odometry>(run.messages());
  EXPECT_EQ(odometry.pose_odom_robot, state.pose_world_robot);
  EXPECT_NEAR(odometry.travel_m, 0.1, 1e-12);
}

TEST(DriveComponent, BelievesWhatItsWheelsCountAndKnowsTheTruth) {
  DriftParameters drift;
  drift.m_per_m = 0.1;
  DriveRun run("", true, 100, drift);
  run.start();

  const domain::State& state = run.step(ahead(0.1));

  EXPECT_NEAR(state.pose_world_robot.x_m, 5.1, 1e-12);
  const auto& odometry = std::get<domain::Odometry>(run.messages());
  EXPECT_NEAR(odometry.pose_odom_robot.x_m, 5.11, 1e-12);
  EXPECT_NEAR(odometry.travel_m, 0.11, 1e-12);
  EXPECT_NEAR(odometry.speed_mps, 0.11 / 0.3, 1e-12);
  EXPECT_EQ(std::get<domain::Target>(run.messages()).position(), core::Vec2(6, 5));
}

TEST(DriveComponent, PassesAWaypointWhereTheRobotBelievesToBe) {
  DriftParameters drift;
  drift.m_per_m = 0.5;
  const world::Goals goals = {{{5.3, 5.0}, 0.02}, {{5.0, 6.0}, 0.2}};
  DriveRun run("", true, 100, drift, {}, goals);
  run.start();
  run.step(ahead(0.1));
  EXPECT_EQ(std::get<domain::Target>(run.messages()).position(), core::Vec2(5.3, 5.0));

  run.step(ahead(0.1));

  // In truth it is at 5.2, where no way-point is.
  EXPECT_NEAR(std::get<domain::Odometry>(run.messages()).pose_odom_robot.x_m, 5.3, 1e-12);
  EXPECT_EQ(std::get<domain::Target>(run.messages()).position(), core::Vec2(5.0, 6.0));
}

TEST(DriveComponent, RestsAndSaysSoWhenACommandIsLate) {
  DriveRun run;
  run.start();

  const domain::State& state = run.step(ahead(0.1), false);

  EXPECT_TRUE(state.command_late);
  EXPECT_EQ(state.pose_world_robot.x_m, 5.0);
}

TEST(DriveComponent, TellsWhyTheRobotRests) {
  DriveRun run;
  run.start();
  run.step(ahead(0.1), false);
  EXPECT_NE(run.told(false).find("The command of the tick before was late"), std::string::npos)
      << run.told(false);
  run.step(ahead(0.1));
  EXPECT_NE(run.told(true).find("It was told to"), std::string::npos) << run.told(true);

  DriveRun waiting("", true, 100, {}, {}, world::Goals{});
  waiting.start();
  waiting.step(ahead(0.1));
  EXPECT_NE(waiting.told(true).find("It has no mission, and waits"), std::string::npos)
      << waiting.told(true);
}

TEST(DriveComponent, TellsOfItsMissionAndWhatTheTickCameTo) {
  DriveRun run("walls: [[5.25, 0, 5.25, 20]]\nwaypoints: [[5.1, 5, 0.01], [5, 7]]");
  run.start();
  EXPECT_NE(run.told(false).find("The robot stands at its start."), std::string::npos);
  EXPECT_NE(run.told(false).find("The mission's way-point 1 of 3 is 0.10 m away."),
            std::string::npos)
      << run.told(false);
  run.step(ahead(0.15));
  EXPECT_NE(run.told(true).find("Something was in the way and cut the motion short."),
            std::string::npos)
      << run.told(true);
  EXPECT_EQ(run.told(true).find("A moving obstacle"), std::string::npos);

  DriveRun alone;
  alone.start();
  alone.step(ahead(0.1));
  EXPECT_NE(alone.told(true).find("The mission's target is 0.90 m away."), std::string::npos)
      << alone.told(true);
  EXPECT_EQ(alone.told(true).find("in the way"), std::string::npos);
}

TEST(DriveComponent, TellsOfAnObstacleThatRunsIntoIt) {
  // A disc of 0.1 m comes at 1 m/s from 0.5 m ahead: after a tick of 0.3 s it is at 0.2 m.
  DriveRun run(
      "moving: [{circle: [5.5, 5, 0.1], path: [[0, 5.5, 5], [0.5, 5, 5]], loop: false}]\n");
  run.start();
  const domain::State& state = run.step({});

  EXPECT_EQ(state.hit_by, 1u);
  EXPECT_NE(run.told(true).find("A moving obstacle ran into it."), std::string::npos)
      << run.told(true);
}

TEST(DriveComponent, TellsHowFarItsOdometryIsOff) {
  DriftParameters drift;
  drift.m_per_m = 0.1;
  DriveRun run("", true, 100, drift);
  run.start();
  run.step(ahead(0.1));

  EXPECT_NE(run.told(true).find("Its odometry is 0.01 m and 0"), std::string::npos)
      << run.told(true);
}

TEST(DriveComponent, RefusesAStateOfOdometryThatIsNone) {
  DriftParameters drift;
  drift.rad_per_sqrt_m = 0.1;
  DriveRun run("", true, 100, drift);
  run.start();
  run.step(ahead(0.1));
  const std::string saved = run.saved();
  ASSERT_EQ(run.fault_of(saved), "");
  const double variance_rad2 = std::get<domain::Odometry>(run.messages()).covariance.heading_rad2;
  const std::string bytes(reinterpret_cast<const char*>(&variance_rad2), sizeof(double));
  const std::size_t at = saved.find(bytes);
  ASSERT_GT(variance_rad2, 0.0);
  ASSERT_NE(at, std::string::npos);
  const double negative = -1.0;
  std::string none = saved;
  none.replace(at, sizeof(double), reinterpret_cast<const char*>(&negative), sizeof(double));

  EXPECT_NE(run.fault_of(none).find("a covariance of the odometry is none"), std::string::npos)
      << run.fault_of(none);
  // It goes on as if it had counted nothing.
  run.step(ahead(0.1));
  EXPECT_NEAR(std::get<domain::Odometry>(run.messages()).travel_m, 0.1, 1e-12);
}

TEST(DriveComponent, ReachesTheTargetWithinItsRadiusAtTheEndOfATick) {
  DriveRun run;
  run.start();

  Outcome outcome = Outcome::kRunning;
  int ticks = 0;
  while (outcome == Outcome::kRunning && ticks < 20) {
    outcome = run.step(ahead(0.15)).outcome;
    ++ticks;
  }

  EXPECT_EQ(outcome, Outcome::kReached);
  EXPECT_EQ(ticks, 6);  // 0.8 m of 1 m, in steps of 0.15 m
}

TEST(DriveComponent, EndsWithACollisionWithoutTheSafetyLayer) {
  DriveRun run("walls: [[5.2, 0, 5.2, 20]]", false);
  run.start();

  const domain::State& state = run.step(ahead(0.15));

  EXPECT_EQ(state.outcome, Outcome::kCollided);
  EXPECT_EQ(state.collisions, 1u);
}

TEST(DriveComponent, GoesOnAfterAnInterventionAndTellsTheContacts) {
  DriveRun run("walls: [[5.2, 0, 5.2, 20]]");
  run.start();

  const domain::State& state = run.step(ahead(0.15));

  EXPECT_EQ(state.outcome, Outcome::kRunning);
  EXPECT_EQ(state.safety_stops, 1u);
  const auto& odometry = std::get<domain::Odometry>(run.messages());
  EXPECT_TRUE(odometry.blocked);
  EXPECT_EQ(odometry.contact_bearings_rad.size(), 1u);
}

TEST(DriveComponent, EndsAsUnreachableWhenControlGivesUp) {
  DriveRun run;
  run.start();
  Motion motion;
  motion.kind = CommandKind::kGiveUp;

  EXPECT_EQ(run.step(motion).outcome, Outcome::kUnreachable);
}

TEST(DriveComponent, EndsAtTheLastTick) {
  DriveRun run("", true, 3);
  run.start();

  EXPECT_EQ(run.step({}).outcome, Outcome::kRunning);
  EXPECT_EQ(run.step({}).outcome, Outcome::kRunning);
  EXPECT_EQ(run.step({}).outcome, Outcome::kTimeout);
}

}  // namespace
}  // namespace clew::drive
