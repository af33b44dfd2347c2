// SPDX-License-Identifier: Apache-2.0
#include "control/behaviourist/fuzzy_behaviourist.hpp"

#include <gtest/gtest.h>

#include "core/angle.hpp"
#include "tests/source_files.hpp"

namespace clew::control {
namespace {

using tests::file_of;

using core::radians;

constexpr double kTolerance = 1e-12;
constexpr double kRange_m = 2.0;

core::Resource shipped() { return file_of("configs/rulebases/pin_bender_fba.yaml"); }

FuzzyBehaviourist controller() {
  return FuzzyBehaviourist(BehaviouristRules::parse(shipped()).value());
}

/// Three beams: left, ahead, right.
domain::Scan scan_of(double left_m, double front_m, double right_m) {
  domain::Scan scan;
  scan.bearing_first_rad = radians(90.0);
  scan.bearing_step_rad = radians(-90.0);
  scan.range_max_m = kRange_m;
  scan.ranges_m = {left_m, front_m, right_m};
  return scan;
}

domain::Motion step(const domain::Scan& scan, const core::Vec2& target) {
  return controller().step(domain::Odometry{}, scan, target);
}

TEST(FuzzyBehaviourist, GoesStraightToATargetAheadInTheOpen) {
  const domain::Motion motion = step(scan_of(kRange_m, kRange_m, kRange_m), {5, 0});

  EXPECT_EQ(motion.kind, domain::CommandKind::kVelocities);
  EXPECT_NEAR(motion.turn_rate_radps, 0.0, kTolerance);
  EXPECT_NEAR(motion.speed_mps, 0.4, kTolerance);
}

TEST(FuzzyBehaviourist, TurnsToTheTargetByItsBearing) {
  const domain::Scan open = scan_of(kRange_m, kRange_m, kRange_m);

  // 15 degrees: half *ahead* (0), half *left* (0.5); beyond 90 degrees *far left* alone.
  EXPECT_NEAR(step(open, {core::cos(radians(15.0)), core::sin(radians(15.0))}).turn_rate_radps,
              0.25, 1e-9);
  EXPECT_NEAR(step(open, {-1, 0.5}).turn_rate_radps, 0.8, kTolerance);
  EXPECT_NEAR(step(open, {-1, -0.5}).turn_rate_radps, -0.8, kTolerance);
}

TEST(FuzzyBehaviourist, WeighsElementalBehavioursByTheirAreas) {
  // Left is near (0.05 m): weight 3, turn -0.6, speed 0.2; the target ahead: turn 0, weight 1; the
  // way ahead is far: speed 0.4, weight 1.
  const domain::Motion motion = step(scan_of(0.05, kRange_m, kRange_m), {5, 0});

  EXPECT_NEAR(motion.turn_rate_radps, (1.0 * 0.0 + 3.0 * -0.6) / 4.0, kTolerance);
  EXPECT_NEAR(motion.speed_mps, (1.0 * 0.4 + 3.0 * 0.2) / 4.0, kTolerance);
}

TEST(FuzzyBehaviourist, MultipliesTheDegreesOfARulesConditions) {
  // 0.15 m ahead is near; the left is 0.05 m freer: turn left alone, weight 8. Both sides are far.
  const domain::Motion motion = step(scan_of(0.55, 0.15, 0.5), {5, 0});

  EXPECT_NEAR(motion.turn_rate_radps, 8.0 * 0.8 / (1.0 + 8.0), 1e-9);
  EXPECT_NEAR(motion.speed_mps, 0.0, kTolerance);
}

TEST(FuzzyBehaviourist, DecidesBeforeASymmetricWall) {
  EXPECT_GT(step(scan_of(kRange_m, 0.1, kRange_m), {5, 0}).turn_rate_radps, 0.1);
}

TEST(FuzzyBehaviourist, TakesTheLeastReadingOfASector) {
  domain::Scan cones;
  cones.bearing_first_rad = radians(45.0);
  cones.bearing_step_rad = radians(-15.0);
  cones.range_max_m = kRange_m;
  cones.ranges_m = {kRange_m, 0.05, kRange_m, kRange_m, kRange_m, kRange_m, kRange_m};

  // 30 degrees is left of the front sector.
  EXPECT_NEAR(step(cones, {5, 0}).turn_rate_radps, -0.45, kTolerance);
}

std::string refusal_of(const std::string& from, const std::string& to) {
  std::string text = shipped().text;
  const auto rules =
      BehaviouristRules::parse({"rules.yaml", text.replace(text.find(from), from.size(), to)});
  return rules.ok() ? "accepted" : rules.error().message;
}

TEST(BehaviouristRules, RefuseWhatIsNoRuleBase) {
  EXPECT_EQ(refusal_of("{near: 0.15, far: 0.6}", "{near: 0.6, far: 0.15}"),
            "front_m needs two sets or more, with peaks that rise");
  EXPECT_EQ(refusal_of("{near: 0.15, far: 0.6}", "{near: 0.15}"),
            "front_m needs two sets or more, with peaks that rise");
  EXPECT_EQ(refusal_of("turn_rate_radps: 0}", "weight: 2}"),
            "a rule needs turn_rate_radps or speed_mps");
  EXPECT_EQ(refusal_of("{if: {target_deg: ahead}", "{if: {}"), "a rule needs a condition");
  EXPECT_EQ(refusal_of("turn_rate_radps: 0}", "turn_rate_radps: 90}"),
            "found 90, expected a number from -20 to 20");
  EXPECT_NE(refusal_of("target_deg: ahead}", "target_deg: aheed}").find("ahead"),
            std::string::npos);
  EXPECT_NE(refusal_of("{if: {target_deg: ahead}", "{if: {targets_deg: ahead}").find("target_deg"),
            std::string::npos);
}

TEST(FuzzyBehaviourist, RefusesASensorThatMissesASector) {
  domain::BehaviourSetup setup;
  setup.scan = {"laser", 5, radians(20.0), radians(-10.0), 0.0, 2.0};

  const auto made = FuzzyBehaviourist::create({}, setup);

  ASSERT_FALSE(made.ok());
  EXPECT_EQ(
      made.error().message,
      "fuzzy_behaviourist needs beams ahead (within 25 degrees), on the left and on the right "
      "(25 to 100 degrees); 'laser' gives 5, from 20 degrees in steps of -10");
}

}  // namespace
}  // namespace clew::control
