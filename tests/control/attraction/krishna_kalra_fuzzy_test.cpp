// SPDX-License-Identifier: Apache-2.0
#include "control/attraction/krishna_kalra_fuzzy.hpp"

#include <gtest/gtest.h>

#include "tests/source_files.hpp"

namespace clew::control {
namespace {

using tests::rule_base;

using core::radians;
using Readings = KrishnaKalraFuzzy::Readings;

constexpr double kTolerance = 1e-12;
constexpr Readings kAllFar = {1, 1, 1, 1, 1, 1, 1};

KrishnaKalraFuzzy controller(TargetTurn target_turn = TargetTurn::kClipped) {
  KrishnaKalraFuzzyParameters parameters;
  parameters.target_turn = target_turn;
  return {parameters, KrishnaKalraRules::parse(rule_base("krishna_kalra_control")).value()};
}

/// A scan of the paper's seven cones with a range of 1 m, so that readings are shares.
domain::Scan scan_of(const Readings& u) {
  domain::Scan scan;
  scan.bearing_first_rad = radians(45.0);
  scan.bearing_step_rad = radians(-15.0);
  scan.beam_width_rad = radians(15.0);
  scan.range_max_m = 1.0;
  scan.ranges_m.assign(u.begin(), u.end());
  return scan;
}

domain::Odometry at(double x_m, double y_m, double heading_deg) {
  domain::Odometry odometry;
  odometry.pose_odom_robot = {x_m, y_m, radians(heading_deg)};
  return odometry;
}

TEST(KrishnaKalraFuzzy, NearFallsFromOneToZeroOverItsBand) {
  const auto fuzzy = controller();

  // Eq. 4 as read here: 1 up to 0.3, 1.75 - 2.5 u, 0 from 0.7.
  EXPECT_EQ(fuzzy.near(0.0), 1.0);
  EXPECT_EQ(fuzzy.near(0.3), 1.0);
  EXPECT_NEAR(fuzzy.near(0.4), 0.75, kTolerance);
  EXPECT_NEAR(fuzzy.near(0.5), 0.5, kTolerance);
  EXPECT_EQ(fuzzy.near(0.7), 0.0);
  EXPECT_EQ(fuzzy.near(1.0), 0.0);
}

TEST(KrishnaKalraFuzzy, TargetTurnIsTheDifferenceAngleWithinNineDegrees) {
  const auto fuzzy = controller();

  EXPECT_EQ(fuzzy.target_turn_rad(0.0), 0.0);
  EXPECT_NEAR(fuzzy.target_turn_rad(radians(4.0)), radians(4.0), kTolerance);
  EXPECT_NEAR(fuzzy.target_turn_rad(radians(120.0)), radians(9.0), kTolerance);
  EXPECT_NEAR(fuzzy.target_turn_rad(radians(-30.0)), radians(-9.0), kTolerance);
}

TEST(KrishnaKalraFuzzy, TargetTurnAsPrintedIsAlwaysNineDegrees) {
  const auto fuzzy = controller(TargetTurn::kBangBang);

  // Eqs 1 to 3: only one membership is not 0, and its share of itself is 1; 0/0 at 0 is read as 0.
  EXPECT_NEAR(fuzzy.target_turn_rad(radians(1.0)), radians(9.0), kTolerance);
  EXPECT_NEAR(fuzzy.target_turn_rad(radians(-170.0)), radians(-9.0), kTolerance);
  EXPECT_EQ(fuzzy.target_turn_rad(0.0), 0.0);
}

TEST(KrishnaKalraFuzzy, ObstacleTurnIsTheMeanOverSevenSensors) {
  const auto fuzzy = controller();

  // Eq. 6, with n = (40, 55, 70, 45, -70, -55, -40) and f = 0: its denominator is 7.
  EXPECT_EQ(fuzzy.obstacle_turn_rad(kAllFar), 0.0);
  EXPECT_NEAR(fuzzy.obstacle_turn_rad({0.1, 0.2, 0.3, 1, 1, 1, 1}), radians(165.0 / 7.0),
              kTolerance);
  EXPECT_NEAR(fuzzy.obstacle_turn_rad({1, 1, 1, 1, 1, 0.5, 0}), radians((-27.5 - 40.0) / 7.0),
              kTolerance);
  EXPECT_NEAR(fuzzy.obstacle_turn_rad({0, 0, 0, 0, 0, 0, 0}), radians(45.0 / 7.0), kTolerance);
}

TEST(KrishnaKalraFuzzy, TargetModuleWeighsTheProductOfTheThreeSides) {
  const auto fuzzy = controller();

  // Eq. 7: far(min left) far(centre) far(min right); far(0.5) = 0.5, far(0.6) = 0.75.
  EXPECT_EQ(fuzzy.target_weight(kAllFar), 1.0);
  EXPECT_NEAR(fuzzy.target_weight({0.9, 0.5, 0.8, 0.6, 1, 1, 1}), 0.5 * 0.75, kTolerance);
  EXPECT_NEAR(fuzzy.target_weight({1, 1, 1, 0.6, 0.8, 0.6, 0.5}), 0.75 * 0.5, kTolerance);
  EXPECT_EQ(fuzzy.target_weight({1, 1, 1, 0.2, 1, 1, 1}), 0.0);
}

TEST(KrishnaKalraFuzzy, StepsShortenNearTheTarget) {
  const auto fuzzy = controller();

  // Eq. 9: 0.05 near + 0.15 far.
  EXPECT_NEAR(fuzzy.target_step_m(1.0), 0.15, kTolerance);
  EXPECT_NEAR(fuzzy.target_step_m(0.5), 0.10, kTolerance);
  EXPECT_NEAR(fuzzy.target_step_m(0.1), 0.05, kTolerance);
}

TEST(KrishnaKalraFuzzy, StepsShortenWithTheNearestObstacle) {
  const auto fuzzy = controller();

  // Eq. 10: the largest nearness decides; near(0.4) = 0.75.
  EXPECT_NEAR(fuzzy.obstacle_step_m(kAllFar), 0.15, kTolerance);
  EXPECT_NEAR(fuzzy.obstacle_step_m({1, 0.6, 1, 1, 0.4, 1, 1}), 0.05 * 0.75 + 0.15 * 0.25,
              kTolerance);
}

TEST(KrishnaKalraFuzzy, TurnsCounterClockwiseTowardATargetOnTheLeft) {
  auto fuzzy = controller();

  const domain::Motion motion = fuzzy.step(at(0, 0, 0), scan_of(kAllFar), {3, 3});

  // 45 degrees to the left, clipped to 9; positive is left here, right in the paper.
  EXPECT_EQ(motion.kind, domain::CommandKind::kTurnAndStep);
  EXPECT_NEAR(motion.turn_rad, radians(9.0), kTolerance);
  EXPECT_NEAR(motion.step_m, 0.15, kTolerance);
}

TEST(KrishnaKalraFuzzy, BlendsBothModulesByTheirWeights) {
  auto fuzzy = controller();
  const Readings u = {0.5, 1, 1, 1, 1, 1, 1};

  const domain::Motion motion = fuzzy.step(at(0, 0, 0), scan_of(u), {3, 3});

  // w1 = 0.5; y^t = -9 degrees (clockwise positive), y^o = 40 x 0.5 / 7; s^t = 0.15, s^o = 0.10.
  EXPECT_NEAR(motion.turn_rad, -radians(0.5 * -9.0 + 0.5 * 20.0 / 7.0), kTolerance);
  EXPECT_NEAR(motion.step_m, 0.5 * 0.15 + 0.5 * 0.10, kTolerance);
}

TEST(KrishnaKalraFuzzy, KeepsTheSideOfATargetBehindIt) {
  auto fuzzy = controller();
  fuzzy.step(at(0, 0, 0), scan_of(kAllFar), {-1, -1});  // clearly on the right

  // Now 177 degrees to the left: within 10 degrees of straight behind.
  const domain::Motion motion = fuzzy.step(at(0, 0, 0), scan_of(kAllFar), {-1, 0.05});

  EXPECT_NEAR(motion.turn_rad, -radians(9.0), kTolerance);
}

TEST(KrishnaKalraFuzzy, GoesOnAsBeforeAfterSaveAndLoad) {
  auto fuzzy = controller();
  fuzzy.step(at(0, 0, 0), scan_of(kAllFar), {-1, -1});
  core::StateWriter writer;
  fuzzy.save(writer);

  auto restored = controller();
  core::StateReader reader(writer.bytes());
  restored.load(reader);

  EXPECT_TRUE(reader.complete());
  EXPECT_EQ(restored.step(at(0, 0, 0), scan_of(kAllFar), {-1, 0.05}).turn_rad,
            fuzzy.step(at(0, 0, 0), scan_of(kAllFar), {-1, 0.05}).turn_rad);
}

TEST(KrishnaKalraFuzzy, RefusesASensorThatIsNotSevenCones) {
  domain::BehaviourSetup setup;
  setup.resources.add("rulebases", "krishna_kalra_control", rule_base("krishna_kalra_control"));
  setup.scan = {"four_infrared", 4, radians(90.0), radians(-60.0), 0.0, 0.8};

  const auto made = KrishnaKalraFuzzy::create({}, setup);

  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.error().message,
            "krishna_kalra_fuzzy needs seven beams, 15 degrees apart from 45 on the left to 45 on "
            "the right; 'four_infrared' gives 4 of another arrangement");
}

}  // namespace
}  // namespace clew::control
