// SPDX-License-Identifier: Apache-2.0
#include "control/step_guard.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clew::control {
namespace {

using core::radians;

constexpr double kRadius_m = 0.15;
constexpr double kRho_m = 0.20;  // radius and margin of 0.05 m

domain::Scan free_scan() {
  domain::Scan scan;
  scan.bearing_first_rad = radians(45.0);
  scan.bearing_step_rad = radians(-15.0);
  scan.beam_width_rad = radians(15.0);
  scan.range_max_m = 1.5;
  scan.ranges_m.assign(7, 1.5);
  return scan;
}

domain::Scan scan_with(std::size_t cone, double reading_m) {
  domain::Scan scan = free_scan();
  scan.ranges_m[cone] = reading_m;
  return scan;
}

domain::Motion motion_of(double turn_deg, double step_m) {
  domain::Motion motion;
  motion.kind = domain::CommandKind::kTurnAndStep;
  motion.turn_rad = radians(turn_deg);
  motion.step_m = step_m;
  return motion;
}

domain::Odometry odometry_at(double travel_m) {
  domain::Odometry odometry;
  odometry.travel_m = travel_m;
  return odometry;
}

StepGuard guard(bool enabled = true) {
  StepGuardParameters parameters;
  parameters.enabled = enabled;
  domain::BehaviourSetup setup;
  setup.robot.radius_m = kRadius_m;
  setup.tick_s = 0.3;
  return {parameters, setup};
}

/// The guard of a drive with a tick of 0.1 s that brakes with 0.5 m/s^2 and turns by 45 deg/s.
StepGuard guard_of_a_heavy_robot() {
  domain::BehaviourSetup setup;
  setup.robot.radius_m = kRadius_m;
  setup.tick_s = 0.1;
  setup.limits.speed_mps = 0.6;
  setup.limits.turn_rate_radps = radians(45.0);
  setup.limits.acceleration_mps2 = 0.5;
  return {{}, setup};
}

domain::Motion velocities_of(double speed_mps, double turn_rate_radps) {
  domain::Motion motion;
  motion.kind = domain::CommandKind::kVelocities;
  motion.speed_mps = speed_mps;
  motion.turn_rate_radps = turn_rate_radps;
  return motion;
}

TEST(StepGuard, LetsARobotThatIsLedPassWithLessRoomWhereItWouldBeHeld) {
  // 0.18 m from the centre, and the arc's end is 37.5 degrees off the way.
  const domain::Scan tight = scan_with(0, 0.03);
  const double ahead_m = 0.18 * std::cos(radians(37.5));
  const double beside_m = 0.18 * std::sin(radians(37.5));
  const double free_m = ahead_m - std::sqrt(0.16 * 0.16 - beside_m * beside_m);

  EXPECT_EQ(guard().limit(motion_of(0, 0.15), odometry_at(0), tight).step_m, 0.0);
  const domain::Motion led =
      guard().limit(motion_of(0, 0.15), odometry_at(0), tight, StepGuard::Steers::kLed);
  EXPECT_EQ(led.turn_rad, 0.0);
  EXPECT_NEAR(led.step_m, free_m, 1e-9);
  // Where its own margin leaves a step, that is kept.
  const domain::Scan wide = scan_with(3, 0.1);
  EXPECT_NEAR(
      guard().limit(motion_of(0, 0.15), odometry_at(0), wide, StepGuard::Steers::kLed).step_m, 0.05,
      1e-9);
}

TEST(StepGuard, LetsAFreeStepPass) {
  const domain::Motion motion = guard().limit(motion_of(5, 0.15), odometry_at(0), free_scan());

  EXPECT_EQ(motion.turn_rad, radians(5.0));
  EXPECT_EQ(motion.step_m, 0.15);
}

TEST(StepGuard, CutsAStepToTheMarginBeforeWhatIsAhead) {
  const domain::Motion motion =
      guard().limit(motion_of(0, 0.15), odometry_at(0), scan_with(3, 0.12));

  // 0.27 m from the centre, less radius and margin.
  EXPECT_NEAR(motion.step_m, 0.07, 1e-12);
  EXPECT_EQ(motion.turn_rad, 0.0);
}

TEST(StepGuard, TakesAReadingAsAnArcThatMayBeAtItsNearEdge) {
  const domain::Motion motion =
      guard().limit(motion_of(0, 0.15), odometry_at(0), scan_with(1, 0.1));

  // Cone 1 spans 22.5 to 37.5 degrees: a point at 0.25 m, 22.5 degrees off the way.
  const double ahead_m = 0.25 * std::cos(radians(22.5));
  const double beside_m = 0.25 * std::sin(radians(22.5));
  EXPECT_NEAR(motion.step_m, ahead_m - std::sqrt(kRho_m * kRho_m - beside_m * beside_m), 1e-12);
}

TEST(StepGuard, LooksWhereTheTurnLeads) {
  const domain::Scan scan = scan_with(3, 0.12);

  // After a turn of 60 degrees what was ahead is 52.5 degrees off: 0.27 sin 52.5 = 0.214 m beside.
  EXPECT_EQ(guard().limit(motion_of(60, 0.15), odometry_at(0), scan).step_m, 0.15);
}

TEST(StepGuard, TurnsAwayWhereNoStepIsLeft) {
  StepGuard on_left = guard();
  StepGuard on_right = guard();

  const domain::Motion from_left =
      on_left.limit(motion_of(0, 0.15), odometry_at(0), scan_with(2, 0.01));
  const domain::Motion from_right =
      on_right.limit(motion_of(0, 0.15), odometry_at(0), scan_with(4, 0.01));

  EXPECT_EQ(from_left.step_m, 0.0);
  EXPECT_EQ(from_left.turn_rad, radians(-15.0));
  EXPECT_EQ(from_right.turn_rad, radians(15.0));
}

TEST(StepGuard, KeepsTheSideUntilItMovesAgain) {
  StepGuard turning = guard();
  turning.limit(motion_of(0, 0.15), odometry_at(0), scan_with(2, 0.01));

  const domain::Motion still =
      turning.limit(motion_of(0, 0.15), odometry_at(0), scan_with(4, 0.01));
  turning.limit(motion_of(0, 0.15), odometry_at(0), free_scan());
  const domain::Motion anew = turning.limit(motion_of(0, 0.15), odometry_at(0), scan_with(4, 0.01));

  EXPECT_EQ(still.turn_rad, radians(-15.0));
  EXPECT_EQ(anew.turn_rad, radians(15.0));
}

TEST(StepGuard, CountsWhatIsLeftOfAStepAsNothingWhenItIsLess) {
  // 5.5 cm less the margin of 5 cm leaves 5 mm, half of the least step.
  const domain::Motion motion =
      guard().limit(motion_of(0, 0.15), odometry_at(0), scan_with(3, 0.055));

  EXPECT_EQ(motion.step_m, 0.0);
}

TEST(StepGuard, LetsASmallStepPassThatWasAskedFor) {
  EXPECT_EQ(guard().limit(motion_of(0, 0.005), odometry_at(0), free_scan()).step_m, 0.005);
}

TEST(StepGuard, TurnsAwayFromAContactBesideIt) {
  StepGuard touched = guard();
  domain::Odometry odometry = odometry_at(1.0);
  odometry.blocked = true;
  odometry.contact_bearings_rad.push_back(radians(80.0));

  const domain::Motion motion = touched.limit(motion_of(0, 0.15), odometry, free_scan());

  EXPECT_EQ(motion.step_m, 0.0);
  EXPECT_EQ(motion.turn_rad, radians(-15.0));
}

TEST(StepGuard, RemembersAContactUntilTheRobotMoves) {
  StepGuard touched = guard();
  domain::Odometry odometry = odometry_at(1.0);
  odometry.contact_bearings_rad.push_back(radians(80.0));
  touched.limit(motion_of(0, 0.15), odometry, free_scan());
  domain::Odometry turned = odometry_at(1.0);
  turned.pose_odom_robot.heading_rad = radians(-15.0);

  // The contact is now at 95 degrees: going on moves away from it, turning back does not.
  const double going_on_m = touched.limit(motion_of(0, 0.15), turned, free_scan()).step_m;
  const double turning_back_m = touched.limit(motion_of(20, 0.15), turned, free_scan()).step_m;
  const double elsewhere_m =
      touched.limit(motion_of(20, 0.15), odometry_at(1.15), free_scan()).step_m;

  EXPECT_EQ(going_on_m, 0.15);
  EXPECT_EQ(turning_back_m, 0.0);
  EXPECT_EQ(elsewhere_m, 0.15);
}

TEST(StepGuard, LeavesMotionsAloneThatDoNotGoAhead) {
  EXPECT_EQ(guard().limit(velocities_of(-1.0, 0.5), odometry_at(0), scan_with(3, 0.0)).speed_mps,
            -1.0);
  EXPECT_EQ(guard().limit({}, odometry_at(0), scan_with(3, 0.0)).kind, domain::CommandKind::kStop);
  EXPECT_EQ(guard().limit(motion_of(90, 0.0), odometry_at(0), scan_with(3, 0.0)).turn_rad,
            radians(90.0));
  EXPECT_EQ(guard(false).limit(motion_of(0, 0.15), odometry_at(0), scan_with(3, 0.0)).step_m, 0.15);
}

TEST(StepGuard, CutsVelocitiesAsTheStepThatTheyMake) {
  // 0.07 m are free, in a tick of 0.3 s.
  const domain::Motion motion =
      guard().limit(velocities_of(0.5, 0.0), odometry_at(0), scan_with(3, 0.12));

  EXPECT_EQ(motion.kind, domain::CommandKind::kVelocities);
  EXPECT_NEAR(motion.speed_mps, 0.07 / 0.3, 1e-12);
}

TEST(StepGuard, CutsWheelSpeedsToVelocities) {
  domain::Motion wheels;
  wheels.kind = domain::CommandKind::kWheelSpeeds;
  wheels.left_mps = 0.49;
  wheels.right_mps = 0.51;

  const domain::Motion free = guard().limit(wheels, odometry_at(0), free_scan());
  const domain::Motion cut = guard().limit(wheels, odometry_at(0), scan_with(3, 0.12));

  EXPECT_EQ(free.kind, domain::CommandKind::kWheelSpeeds);
  EXPECT_EQ(cut.kind, domain::CommandKind::kVelocities);
  EXPECT_NEAR(cut.speed_mps, 0.07 / 0.3, 1e-3);  // nearly straight ahead
  EXPECT_NEAR(cut.turn_rate_radps, 0.02 / 0.3, 1e-12);
}

TEST(StepGuard, KeepsTheWayFreeInWhichTheDriveCanBrake) {
  // 0.30 m less the margin are 0.25 m free: v 0.1 + v^2 / (2 0.5) = 0.25 at v = 0.4525.
  const domain::Motion cut =
      guard_of_a_heavy_robot().limit(velocities_of(0.6, 0.0), odometry_at(0), scan_with(3, 0.30));
  // 0.6 m/s need 0.06 + 0.36 = 0.42 m.
  const domain::Motion free =
      guard_of_a_heavy_robot().limit(velocities_of(0.6, 0.0), odometry_at(0), scan_with(3, 0.48));

  EXPECT_NEAR(cut.speed_mps * 0.1 + cut.speed_mps * cut.speed_mps, 0.25, 1e-12);
  EXPECT_EQ(free.speed_mps, 0.6);
}

TEST(StepGuard, LooksWhereTheDriveCanTurnWithinTheTick) {
  // 4.5 degrees are all it turns in a tick of those 60 that are asked for.
  const domain::Motion motion = guard_of_a_heavy_robot().limit(velocities_of(0.6, radians(600.0)),
                                                               odometry_at(0), scan_with(3, 0.06));

  EXPECT_LT(motion.speed_mps, 0.2);
}

TEST(StepGuard, KeepsAsManyContactsAsItHasRoomFor) {
  StepGuard guarded = guard();
  domain::Odometry odometry = odometry_at(1.0);
  for (std::size_t i = 0; i < domain::kMaxContacts; ++i) {
    odometry.contact_bearings_rad.push_back(radians(180.0));
  }
  guarded.limit(motion_of(0, 0.15), odometry, free_scan());
  odometry.contact_bearings_rad.clear();
  odometry.contact_bearings_rad.push_back(0.0);

  // What is ahead came last, and finds no room until the robot has moved.
  EXPECT_EQ(guarded.limit(motion_of(0, 0.15), odometry, free_scan()).step_m, 0.15);
  EXPECT_EQ(guarded.state().contacts_odom_rad.size(), domain::kMaxContacts);
  odometry.travel_m = 1.01;
  EXPECT_EQ(guarded.limit(motion_of(0, 0.15), odometry, free_scan()).step_m, 0.0);
}

TEST(StepGuard, TakesAReadingAtTheSensorsLeastAsContact) {
  domain::Scan scan = scan_with(3, 0.10);
  scan.range_min_m = 0.10;

  EXPECT_EQ(guard().limit(motion_of(0, 0.15), odometry_at(0), scan).step_m, 0.0);
}

}  // namespace
}  // namespace clew::control
