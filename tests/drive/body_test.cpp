// SPDX-License-Identifier: Apache-2.0
#include "drive/body.hpp"

#include <gtest/gtest.h>

#include <string>

namespace clew::drive {
namespace {

constexpr double kRadius_m = 0.15;
constexpr double kMargin_m = 0.005;
constexpr double kTolerance_m = 1e-6;  // the sweep stops a little before contact

world::World make_world(const std::string& obstacles) {
  auto world =
      world::World::parse("format: clew-world/1\nname: test\nbounds: [0, 0, 20, 20]\n" + obstacles +
                              "\nstart: [5, 5, 0]\ntarget: [19, 19]\ntarget_radius: 0.2\n",
                          "test.yaml");
  EXPECT_TRUE(world.ok()) << world.error().text();
  return std::move(world).value();
}

Legs one_leg(double turn_rad, double step_m) {
  Legs legs;
  legs.push_back({turn_rad, step_m, 0.3, 0.0});
  return legs;
}

const SafetyParameters kWithout = {false, kMargin_m};

TEST(Body, TurnsThenSteps) {
  Body body({5, 5, 0}, kRadius_m, {});

  body.move(make_world(""), one_leg(core::radians(90.0), 0.1), 0.0);

  const Body::State& state = body.state();
  EXPECT_NEAR(state.pose_world_robot.x_m, 5.0, 1e-12);
  EXPECT_NEAR(state.pose_world_robot.y_m, 5.1, 1e-12);
  EXPECT_NEAR(state.pose_world_robot.heading_rad, core::radians(90.0), 1e-12);
  EXPECT_NEAR(state.speed_mps, 0.1 / 0.3, 1e-12);
  EXPECT_NEAR(state.turn_rate_radps, core::radians(90.0) / 0.3, 1e-12);
  EXPECT_NEAR(state.path_length_m, 0.1, 1e-12);
  EXPECT_FALSE(state.blocked);
}

TEST(Body, WrapsItsHeading) {
  Body body({5, 5, 3.0}, kRadius_m, {});

  body.move(make_world(""), one_leg(1.0, 0.0), 0.0);

  EXPECT_NEAR(body.state().pose_world_robot.heading_rad, 4.0 - 2.0 * core::kPi, 1e-12);
}

TEST(Body, IsStoppedShortOfContactByTheSafetyLayer) {
  Body body({5, 5, 0}, kRadius_m, {true, kMargin_m});

  body.move(make_world("walls: [[5.2, 0, 5.2, 20]]"), one_leg(0.0, 0.15), 0.0);

  // The wall is 0.2 m ahead: the disc and the margin leave 0.045 m.
  const Body::State& state = body.state();
  EXPECT_NEAR(state.pose_world_robot.x_m, 5.2 - kRadius_m - kMargin_m, kTolerance_m);
  EXPECT_NEAR(state.path_length_m, 0.045, kTolerance_m);
  EXPECT_EQ(state.safety_stops, 1u);
  EXPECT_EQ(state.collisions, 0u);
  EXPECT_TRUE(state.blocked);
  ASSERT_EQ(state.contact_bearings_rad.size(), 1u);
  EXPECT_NEAR(state.contact_bearings_rad[0], 0.0, 1e-6);
}

TEST(Body, CountsEachInterventionAndForgetsTheContactWhenItMovesFreely) {
  const world::World world = make_world("walls: [[5.2, 0, 5.2, 20]]");
  Body body({5, 5, 0}, kRadius_m, {true, kMargin_m});

  body.move(world, one_leg(0.0, 0.15), 0.0);
  body.move(world, one_leg(0.0, 0.15), 0.3);
  body.move(world, one_leg(core::radians(180.0), 0.15), 0.6);

  EXPECT_EQ(body.state().safety_stops, 2u);
  EXPECT_FALSE(body.state().blocked);
  EXPECT_TRUE(body.state().contact_bearings_rad.empty());
  EXPECT_NEAR(body.state().pose_world_robot.x_m, 5.2 - kRadius_m - kMargin_m - 0.15, kTolerance_m);
}

TEST(Body, TellsTheContactsBearingInItsOwnFrame) {
  Body body({5, 5, 0}, kRadius_m, {true, kMargin_m});

  body.move(make_world("walls: [[0, 5.18, 20, 5.18]]"), one_leg(core::radians(30.0), 0.15), 0.0);

  // The wall is straight up; the robot heads 30 degrees: 60 degrees to its left.
  ASSERT_EQ(body.state().contact_bearings_rad.size(), 1u);
  EXPECT_NEAR(body.state().contact_bearings_rad[0], core::radians(60.0), 1e-3);
}

TEST(Body, MayMoveAlongAWallThatItTouches) {
  Body body({5, 5, 0}, kRadius_m, {true, kMargin_m});

  body.move(make_world("walls: [[0, 5.155, 20, 5.155]]"), one_leg(0.0, 0.15), 0.0);

  EXPECT_EQ(body.state().safety_stops, 0u);
  EXPECT_NEAR(body.state().pose_world_robot.x_m, 5.15, kTolerance_m);
}

TEST(Body, NeverJumpsThroughAThinWall) {
  Body body({5, 5, 0}, kRadius_m, {true, kMargin_m});

  body.move(make_world("walls: [[6, 0, 6, 20]]"), one_leg(0.0, 10.0), 0.0);

  EXPECT_LT(body.state().pose_world_robot.x_m, 6.0 - kRadius_m);
}

TEST(Body, CollidesWithoutTheSafetyLayer) {
  Body body({5, 5, 0}, kRadius_m, kWithout);

  body.move(make_world("walls: [[5.2, 0, 5.2, 20]]"), one_leg(0.0, 0.15), 0.0);

  EXPECT_EQ(body.state().collisions, 1u);
  EXPECT_EQ(body.state().safety_stops, 0u);
  EXPECT_NEAR(body.state().pose_world_robot.x_m, 5.2 - kRadius_m, kTolerance_m);
}

TEST(Body, DoesNotGoOnInTheSameTickAfterItWasStopped) {
  Legs legs;
  legs.push_back({0.0, 0.15, 0.15, 0.0});
  legs.push_back({core::radians(90.0), 0.15, 0.15, 0.0});
  Body body({5, 5, 0}, kRadius_m, {true, kMargin_m});

  body.move(make_world("walls: [[5.2, 0, 5.2, 20]]"), legs, 0.0);

  EXPECT_NEAR(body.state().pose_world_robot.y_m, 5.0, kTolerance_m);
  EXPECT_NEAR(body.state().pose_world_robot.heading_rad, core::radians(90.0), 1e-12);
  EXPECT_EQ(body.state().safety_stops, 1u);
}

Legs one_arc(double step_m, double bend_rad) {
  Legs legs;
  legs.push_back({0.0, step_m, 0.1, bend_rad});
  return legs;
}

TEST(Body, GoesAlongAnArc) {
  Body body({5, 5, 0}, kRadius_m, {});

  body.move(make_world(""), one_arc(core::kPi / 2.0, core::radians(90.0)), 0.0);

  // A quarter of a circle of 1 m to the left.
  const Body::State& state = body.state();
  EXPECT_NEAR(state.pose_world_robot.x_m, 6.0, 1e-12);
  EXPECT_NEAR(state.pose_world_robot.y_m, 6.0, 1e-12);
  EXPECT_NEAR(state.pose_world_robot.heading_rad, core::radians(90.0), 1e-12);
  EXPECT_NEAR(state.path_length_m, core::kPi / 2.0, 1e-12);
  EXPECT_NEAR(state.speed_mps, core::kPi / 2.0 / 0.1, 1e-9);
  EXPECT_NEAR(state.turn_rate_radps, core::radians(90.0) / 0.1, 1e-9);
}

TEST(Body, GoesBackwards) {
  Body body({5, 5, 0}, kRadius_m, {});

  body.move(make_world(""), one_arc(-0.2, 0.0), 0.0);

  EXPECT_NEAR(body.state().pose_world_robot.x_m, 4.8, 1e-12);
  EXPECT_NEAR(body.state().speed_mps, -2.0, 1e-9);
  EXPECT_NEAR(body.state().path_length_m, 0.2, 1e-12);
}

TEST(Body, IsStoppedOnAnArcAndStillTurns) {
  const double wall_m = 5.5;
  Body body({5, 5, 0}, kRadius_m, {true, kMargin_m});

  body.move(make_world("walls: [[0, 5.5, 20, 5.5]]"), one_arc(core::kPi / 2.0, core::radians(90.0)),
            0.0);

  // It stops where its centre is a disc and the margin short of the wall, on a circle of 1 m:
  // y = 6 - cos(angle).
  const double y_m = wall_m - kRadius_m - kMargin_m;
  const double angle_rad = core::acos(6.0 - y_m);
  const Body::State& state = body.state();
  EXPECT_NEAR(state.pose_world_robot.y_m, y_m, 2e-6);
  EXPECT_NEAR(state.pose_world_robot.x_m, 5.0 + core::sin(angle_rad), 1e-5);
  EXPECT_NEAR(state.pose_world_robot.heading_rad, core::radians(90.0), 1e-12);
  EXPECT_EQ(state.safety_stops, 1u);
  EXPECT_TRUE(state.blocked);
}

// A disc of 0.2 m comes from the right along y = 5 at 1 m/s: its edge is at x = 5.8 at time 0.
constexpr char kComing[] =
    "moving: [{circle: [6, 5, 0.2], path: [[0, 6, 5], [2, 4, 5]], loop: false}]";

TEST(Body, IsHitByAnObstacleThatRunsIntoIt) {
  const world::World world = make_world(kComing);
  Body body({5, 5, 0}, kRadius_m, {true, kMargin_m});

  for (int tick = 0; tick < 10; ++tick) body.move(world, one_leg(0.0, 0.0), 0.3 * tick);

  // It reaches the standing robot's skin (x = 5.15) after 0.65 s, and passes over it: one contact.
  EXPECT_EQ(body.state().hit_by, 1u);
  EXPECT_EQ(body.state().collisions, 0u);
  EXPECT_EQ(body.state().safety_stops, 0u);
}

TEST(Body, IsNotHitByAnObstacleThatPasses) {
  const world::World world = make_world(kComing);
  Body body({5, 5.5, 0}, kRadius_m, {true, kMargin_m});

  for (int tick = 0; tick < 10; ++tick) body.move(world, one_leg(0.0, 0.0), 0.3 * tick);

  EXPECT_EQ(body.state().hit_by, 0u);
}

TEST(Body, StopsBeforeAMovingObstacleThatItDrivesAt) {
  const world::World world = make_world(kComing);
  Body body({5, 5, 0}, kRadius_m, {true, kMargin_m});

  body.move(world, one_leg(0.0, 0.15), 0.45);

  // At 0.45 s the gap is 0.35 - 0.15 m = 0.2 m and closes at 1.5 m/s: 0.133 s of the tick.
  EXPECT_EQ(body.state().safety_stops, 1u);
  EXPECT_EQ(body.state().hit_by, 1u);  // it stands, and the obstacle comes on
}

}  // namespace
}  // namespace clew::drive
