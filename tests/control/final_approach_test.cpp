// SPDX-License-Identifier: Apache-2.0
#include "control/final_approach.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clew::control {
namespace {

using core::radians;

/// Seven cones of 1.5 m, of which some return.
domain::Scan scan_of(std::initializer_list<double> readings = {1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5}) {
  domain::Scan scan;
  scan.bearing_first_rad = radians(45.0);
  scan.bearing_step_rad = radians(-15.0);
  scan.beam_width_rad = radians(15.0);
  scan.range_max_m = 1.5;
  scan.ranges_m = readings;
  return scan;
}

/// A wall across, 0.5 m from the skin ahead.
domain::Scan wall_ahead() { return scan_of({0.9, 0.62, 0.53, 0.5, 0.53, 0.62, 0.9}); }

/// On its way already.
domain::Odometry odometry_at(double x_m, double y_m, double heading_deg) {
  domain::Odometry odometry;
  odometry.pose_odom_robot = {x_m, y_m, radians(heading_deg)};
  odometry.travel_m = 1.0;
  return odometry;
}

FinalApproach approach(double acceleration_mps2 = std::numeric_limits<double>::infinity()) {
  domain::BehaviourSetup setup;
  setup.tick_s = 0.5;
  setup.limits.speed_mps = 0.4;
  setup.limits.turn_rate_radps = radians(90.0);
  setup.limits.acceleration_mps2 = acceleration_mps2;
  return FinalApproach({}, setup);
}

TEST(FinalApproach, GoesStraightToANearTarget) {
  FinalApproach straight = approach();

  const auto far_step = straight.step(odometry_at(0, 0, 0), scan_of(), {1.0, 0.0});
  const auto last_step = straight.step(odometry_at(0.9, 0, 0), scan_of(), {1.0, 0.0});

  ASSERT_TRUE(far_step.has_value());
  EXPECT_EQ(far_step->turn_rad, 0.0);
  EXPECT_DOUBLE_EQ(far_step->step_m, 0.2);  // 0.4 m/s for 0.5 s
  ASSERT_TRUE(last_step.has_value());
  EXPECT_NEAR(last_step->step_m, 0.1, 1e-12);
}

TEST(FinalApproach, AStepEndsSoThatTheDriveCanBrake) {
  FinalApproach straight = approach(0.1);

  const auto motion = straight.step(odometry_at(0, 0, 0), scan_of(), {0.05, 0.0});

  // v 0.5 + v^2 / 0.2 = 0.05 has v = 0.0618 m/s.
  ASSERT_TRUE(motion.has_value());
  EXPECT_NEAR(motion->step_m, 0.0309, 1e-4);
}

TEST(FinalApproach, LeavesAFarTargetToTheController) {
  EXPECT_FALSE(approach().step(odometry_at(0, 0, 0), scan_of(), {1.3, 0.0}).has_value());
}

TEST(FinalApproach, AWallBehindTheTargetDoesNotMatter) {
  // The wall is 0.65 m from the centre, the target 0.155 m before it.
  EXPECT_TRUE(approach().step(odometry_at(0, 0, 0), wall_ahead(), {0.495, 0.0}).has_value());
}

TEST(FinalApproach, AWallBeforeTheTargetLeavesItToTheController) {
  EXPECT_FALSE(approach().step(odometry_at(0, 0, 0), wall_ahead(), {0.9, 0.0}).has_value());
}

TEST(FinalApproach, LooksAtATargetBehindOnceAndAgainOnlyElsewhere) {
  FinalApproach straight = approach();
  const core::Vec2 target(-0.9, 0.0);

  const auto look = straight.step(odometry_at(0, 0, 0), scan_of(), target);
  ASSERT_TRUE(look.has_value());
  EXPECT_EQ(look->step_m, 0.0);
  EXPECT_NEAR(std::fabs(look->turn_rad), radians(45.0), 1e-12);  // 90 degrees a second

  // It faces the target and sees a wall before it: the controller's turn, also when it looks away.
  EXPECT_FALSE(straight.step(odometry_at(0, 0, 180), wall_ahead(), target).has_value());
  EXPECT_FALSE(straight.step(odometry_at(0, 0.3, 0), scan_of(), target).has_value());
  EXPECT_TRUE(straight.step(odometry_at(0, 0.6, 0), scan_of(), target).has_value());
}

TEST(FinalApproach, WhereTheGuardHeldItTheControllerSteers) {
  FinalApproach straight = approach();
  ASSERT_TRUE(straight.step(odometry_at(0, 0, 0), scan_of(), {1.0, 0.0}).has_value());

  straight.hold(odometry_at(0, 0, 0));

  EXPECT_FALSE(straight.step(odometry_at(0, 0.3, 0), scan_of(), {1.0, 0.0}).has_value());
  EXPECT_TRUE(straight.step(odometry_at(0, 0.5, 0), scan_of(), {1.0, 0.0}).has_value());
  EXPECT_TRUE(straight.step(odometry_at(0, 0, 0), scan_of(), {0.9, 0.0}).has_value());  // another
}

TEST(FinalApproach, LeavesItToTheControllerWhereTheTargetWasNotWhereItBelieves) {
  FinalApproach straight = approach();
  ASSERT_TRUE(straight.step(odometry_at(0.5, 0, 0), scan_of(), {1.0, 0.0}).has_value());

  EXPECT_FALSE(straight.step(odometry_at(0.995, 0, 0), scan_of(), {1.0, 0.0}).has_value());
  EXPECT_FALSE(straight.step(odometry_at(0.2, 0, 0), scan_of(), {1.0, 0.0}).has_value());
  EXPECT_TRUE(straight.step(odometry_at(0.2, 0, 0), scan_of(), {0.9, 0.0}).has_value());  // another
}

TEST(FinalApproach, TurnsToATargetBesideItBeforeItSetsOff) {
  domain::Odometry at_start = odometry_at(0, 0, 0);
  at_start.travel_m = 0.0;

  const auto beside = approach().step(at_start, scan_of(), {0.0, 5.0});

  ASSERT_TRUE(beside.has_value());
  EXPECT_NEAR(beside->turn_rad, radians(45.0), 1e-12);
  EXPECT_EQ(beside->step_m, 0.0);
  EXPECT_FALSE(approach().step(odometry_at(0, 0, 0), scan_of(), {0.0, 5.0}).has_value());
  EXPECT_FALSE(approach().step(at_start, scan_of(), {0.0, 9.0}).has_value());
}

TEST(FinalApproach, GoesStraightFromAfarUntilItFindsTheWayBlocked) {
  FinalApproachParameters parameters;
  parameters.first_m = 4.0;
  domain::BehaviourSetup setup;
  setup.tick_s = 0.5;
  setup.limits.speed_mps = 0.4;
  const core::Vec2 target(3.5, 0.0);
  FinalApproach first(parameters, setup);

  EXPECT_TRUE(first.step(odometry_at(0, 0, 0), scan_of(), target).has_value());
  EXPECT_FALSE(first.step(odometry_at(0.2, 0, 0), wall_ahead(), target).has_value());
  // From then on only from near by, though the way is free again.
  EXPECT_FALSE(first.step(odometry_at(1.0, 0, 0), scan_of(), target).has_value());
  EXPECT_TRUE(first.step(odometry_at(2.4, 0, 0), scan_of(), target).has_value());
  EXPECT_TRUE(first.step(odometry_at(1.0, 0, 0), scan_of(), {4.0, 0.0}).has_value());  // another
}

TEST(FinalApproach, ATargetThatWasFarWhenItWasSetIsTheControllersUntilItIsNear) {
  FinalApproachParameters parameters;
  parameters.first_m = 4.0;
  FinalApproach first(parameters, {});

  EXPECT_FALSE(first.step(odometry_at(0, 0, 0), scan_of(), {4.1, 0.0}).has_value());
  EXPECT_FALSE(first.step(odometry_at(1.0, 0, 0), scan_of(), {4.1, 0.0}).has_value());
  EXPECT_TRUE(first.step(odometry_at(3.0, 0, 0), scan_of(), {4.1, 0.0}).has_value());
}

TEST(FinalApproach, AfterTheGuardHeldItFromAfarItBeginsFromNearBy) {
  FinalApproachParameters parameters;
  parameters.first_m = 4.0;
  FinalApproach first(parameters, {});
  EXPECT_TRUE(first.step(odometry_at(0, 0, 0), scan_of(), {3.5, 0.0}).has_value());

  first.hold(odometry_at(0, 0, 0));

  EXPECT_FALSE(first.step(odometry_at(1.5, 0, 0), scan_of(), {3.5, 0.0}).has_value());
  EXPECT_TRUE(first.step(odometry_at(2.5, 0, 0), scan_of(), {3.5, 0.0}).has_value());
}

TEST(FinalApproach, OfNoLengthIsThePapers) {
  FinalApproachParameters parameters;
  parameters.approach_m = 0.0;
  parameters.first_m = 4.0;
  FinalApproach none(parameters, {});
  domain::Odometry at_start = odometry_at(0, 0, 0);
  at_start.travel_m = 0.0;

  EXPECT_FALSE(none.step(at_start, scan_of(), {-0.5, 0.0}).has_value());
  EXPECT_FALSE(none.step(odometry_at(0, 0, 0), scan_of(), {0.5, 0.0}).has_value());
}

}  // namespace
}  // namespace clew::control
