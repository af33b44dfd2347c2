// SPDX-License-Identifier: Apache-2.0
#include "control/pursuit/regulated_pure_pursuit.hpp"

#include <gtest/gtest.h>

namespace clew::control {
namespace {

using core::Vec2;

constexpr double kTolerance = 1e-12;
constexpr double kFar_m = 4.0;

domain::BehaviourSetup quick_robot() {
  domain::BehaviourSetup quick;
  quick.tick_s = 0.1;
  quick.limits = {1.0, 2.0, 0.5, 1.5};
  return quick;
}

/// One beam ahead that sees nothing nearer than this.
domain::Scan one_beam(double nearest_m) {
  domain::Scan beam;
  beam.range_max_m = kFar_m;
  beam.ranges_m = {nearest_m};
  return beam;
}

domain::Motion step(const Vec2& place, double nearest_m = kFar_m,
                    const RegulatedPurePursuitParameters& parameters = {}) {
  RegulatedPurePursuit controller(parameters, quick_robot());
  return controller.step({}, one_beam(nearest_m), place);
}

TEST(RegulatedPurePursuit, GoesStraightAheadAtFullSpeed) {
  const domain::Motion motion = step({0.8, 0.0});

  EXPECT_EQ(motion.kind, domain::CommandKind::kVelocities);
  EXPECT_EQ(motion.speed_mps, 0.6);
  EXPECT_EQ(motion.turn_rate_radps, 0.0);
}

TEST(RegulatedPurePursuit, FollowsTheArcThatLeadsToThePlace) {
  // A circle of radius 1 m around (0, 1), through (sin 0.6, 1 - cos 0.6).
  const Vec2 place(core::sin(0.6), 1.0 - core::cos(0.6));

  const domain::Motion left = step(place);
  const domain::Motion right = step({place.x(), -place.y()});

  EXPECT_NEAR(left.turn_rate_radps / left.speed_mps, 1.0, 1e-9);
  EXPECT_EQ(left.speed_mps, 0.6);  // of a curve of more than curve_radius_m
  EXPECT_EQ(right.turn_rate_radps, -left.turn_rate_radps);
}

TEST(RegulatedPurePursuit, DrivesTightCurvesSlower) {
  // A circle of radius 0.25 m, half of curve_radius_m.
  const Vec2 place(0.25 * core::sin(1.0), 0.25 * (1.0 - core::cos(1.0)));

  const domain::Motion motion = step(place);

  EXPECT_NEAR(motion.speed_mps, 0.3, 1e-9);
  EXPECT_NEAR(motion.turn_rate_radps, 0.3 / 0.25, 1e-9);
}

TEST(RegulatedPurePursuit, DrivesSlowerBesideObstaclesButNotBelowTheLeastSpeed) {
  EXPECT_NEAR(step({0.8, 0.0}, 0.1).speed_mps, 0.3, kTolerance);
  EXPECT_NEAR(step({0.8, 0.0}, 0.0).speed_mps, 0.1, kTolerance);
}

TEST(RegulatedPurePursuit, SlowsDownBeforeThePlaceIfItIsToAndDoesNotPassIt) {
  RegulatedPurePursuitParameters parameters;
  parameters.slow_before_m = 0.2;

  EXPECT_NEAR(step({0.1, 0.0}).speed_mps, 0.6, kTolerance);
  EXPECT_NEAR(step({0.1, 0.0}, kFar_m, parameters).speed_mps, 0.3, kTolerance);
  // A tick at least_speed_mps would be 0.01 m.
  EXPECT_NEAR(step({0.005, 0.0}).speed_mps, 0.05, kTolerance);
  EXPECT_EQ(step({0.0, 0.0}).speed_mps, 0.0);
}

TEST(RegulatedPurePursuit, TurnsOnTheSpotToWhatIsBesideIt) {
  const domain::Motion motion = step({0.0, 1.0});

  EXPECT_EQ(motion.speed_mps, 0.0);
  // With w T + w^2 / (2 a) = pi / 2: w = sqrt(0.15^2 + 1.5 pi) - 0.15 = 2.03, and the drive's 2.
  EXPECT_EQ(motion.turn_rate_radps, 2.0);
}

TEST(RegulatedPurePursuit, TurnsNoFasterThanItCanEndTheTurn) {
  RegulatedPurePursuitParameters parameters;
  parameters.turn_first_rad = core::radians(1.0);

  const domain::Motion motion = step({core::cos(0.2), -core::sin(0.2)}, kFar_m, parameters);

  // The rest of the turn after a tick is what braking takes.
  const double rate_radps = -motion.turn_rate_radps;
  EXPECT_NEAR(rate_radps * 0.1 + rate_radps * rate_radps / (2.0 * 1.5), 0.2, 1e-9);
}

TEST(RegulatedPurePursuit, KeepsTheArcWhereTheDriveTurnsTooSlowly) {
  domain::BehaviourSetup slow = quick_robot();
  slow.limits.turn_rate_radps = 0.1;
  RegulatedPurePursuit controller({}, slow);
  const Vec2 place(core::sin(0.6), 1.0 - core::cos(0.6));  // radius 1 m

  const domain::Motion motion = controller.step({}, one_beam(kFar_m), place);

  EXPECT_NEAR(motion.turn_rate_radps, 0.1, kTolerance);
  EXPECT_NEAR(motion.speed_mps, 0.1, 1e-9);
}

TEST(RegulatedPurePursuit, RefusesALeastSpeedAboveTheGreatest) {
  RegulatedPurePursuitParameters parameters;
  parameters.least_speed_mps = 0.7;

  const auto controller = RegulatedPurePursuit::create(parameters, quick_robot());

  ASSERT_FALSE(controller.ok());
  EXPECT_EQ(controller.error().message,
            "control.regulated_pure_pursuit: least_speed_mps must not be greater than speed_mps");
}

}  // namespace
}  // namespace clew::control
