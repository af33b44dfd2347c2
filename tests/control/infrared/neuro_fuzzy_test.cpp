// SPDX-License-Identifier: Apache-2.0
#include "control/infrared/neuro_fuzzy.hpp"

#include <gtest/gtest.h>

#include "tests/control/infrared_scans.hpp"
#include "tests/source_files.hpp"

namespace clew::control {
namespace {

using tests::file_of;

using core::radians;

constexpr double kFree_m = 0.8;

domain::BehaviourSetup setup_with(const domain::ScanLayout& scan) {
  domain::BehaviourSetup setup;
  setup.scan = scan;
  setup.resources.add("rulebases", "wang_yang_meng",
                      file_of("configs/rulebases/wang_yang_meng.yaml"));
  return setup;
}

domain::Motion step(const domain::Scan& scan, const core::Vec2& target, bool target_term) {
  NeuroFuzzyParameters parameters;
  parameters.rules = "wang_yang_meng";
  parameters.target.enabled = target_term;
  auto controller = NeuroFuzzy::create(parameters, setup_with(infrared_layout()));
  EXPECT_TRUE(controller.ok()) << controller.error().text();
  return (*controller)->step(domain::Odometry{}, scan, target);
}

domain::Motion avoid(const domain::Scan& scan) { return step(scan, {-5, 0}, false); }

TEST(NeuroFuzzy, ReadsThePapersSensorsOutOfTheScan) {
  const auto infrareds = FourInfrareds::create(infrared_layout(), "test");
  ASSERT_TRUE(infrareds.ok());

  // I = 255 - round(55.67 + 15.467 / d): 45 at 0.1 m, 122 at 0.2, 161 at 0.4, 180 at 0.8.
  const InfraredReadings readings = infrareds->readings(infrared_scan(0.1, 0.2, 0.4, 0.8));

  EXPECT_EQ(readings, (InfraredReadings{45, 122, 161, 180}));
}

TEST(NeuroFuzzy, CommandsTheWheelsThatItsRulesSay) {
  const domain::Motion free = avoid(infrared_scan(kFree_m, kFree_m, kFree_m, kFree_m));
  const domain::Motion blocked = avoid(infrared_scan(0.1, kFree_m, kFree_m, kFree_m));

  // At a set's centre its neighbour, 45 readings off, holds to 0.062, and mixes in a tenth of that.
  EXPECT_EQ(free.kind, domain::CommandKind::kWheelSpeeds);
  EXPECT_NEAR(free.left_mps, 0.2, 0.012);
  EXPECT_NEAR(free.right_mps, 0.2, 0.012);
  EXPECT_NEAR(blocked.left_mps, 0.0, 0.012);
  EXPECT_NEAR(blocked.right_mps, 0.4, 0.012);
}

TEST(NeuroFuzzy, TurnsAwayFromTheNearerSide) {
  const domain::Motion left = avoid(infrared_scan(kFree_m, kFree_m, 0.12, kFree_m));
  const domain::Motion right = avoid(infrared_scan(kFree_m, kFree_m, kFree_m, 0.12));

  EXPECT_GT(left.left_mps - left.right_mps, 0.15);
  EXPECT_GT(right.right_mps - right.left_mps, 0.15);
}

TEST(NeuroFuzzy, IgnoresTheTargetWithoutItsTerm) {
  const domain::Scan scan = infrared_scan(0.3, kFree_m, 0.2, kFree_m);

  const domain::Motion here = step(scan, {5, 5}, false);
  const domain::Motion there = step(scan, {-5, -1}, false);

  EXPECT_EQ(here.left_mps, there.left_mps);
  EXPECT_EQ(here.right_mps, there.right_mps);
}

TEST(NeuroFuzzy, TargetTermTurnsToTheTargetWhereThatSideIsFree) {
  const domain::Scan open = infrared_scan(kFree_m, kFree_m, kFree_m, kFree_m);
  const domain::Motion plain = step(open, {0, 5}, false);

  const domain::Motion motion = step(open, {0, 5}, true);

  // The target is 90 degrees to the left: no speed ahead, the whole of target_turn_mps.
  EXPECT_NEAR(motion.left_mps - plain.left_mps, -0.2, 1e-12);
  EXPECT_NEAR(motion.right_mps - plain.right_mps, 0.2, 1e-12);
}

TEST(NeuroFuzzy, TargetTermGoesAheadToATargetAhead) {
  // 0.3 m ahead: (0.3 - 0.1) / (0.5 - 0.1) of the speed.
  const domain::Scan scan = infrared_scan(0.3, kFree_m, kFree_m, kFree_m);
  const domain::Motion plain = step(scan, {5, 0}, false);

  const domain::Motion motion = step(scan, {5, 0}, true);

  EXPECT_NEAR(motion.left_mps - plain.left_mps, 0.15, 1e-12);
  EXPECT_NEAR(motion.right_mps - plain.right_mps, 0.15, 1e-12);
}

TEST(NeuroFuzzy, TargetTermKeepsStillNearObstacles) {
  const domain::Scan ahead = infrared_scan(0.1, kFree_m, kFree_m, kFree_m);
  const domain::Scan beside = infrared_scan(kFree_m, kFree_m, 0.1, kFree_m);

  EXPECT_NEAR(step(ahead, {3, 3}, true).left_mps, step(ahead, {3, 3}, false).left_mps, 1e-12);
  EXPECT_NEAR(step(beside, {0, 3}, true).right_mps, step(beside, {0, 3}, false).right_mps, 1e-12);
}

TEST(NeuroFuzzy, RefusesOtherSensorsWithASentence) {
  domain::ScanLayout cones{"cones", 7, radians(45.0), radians(-15.0), radians(15.0), 1.5};
  domain::ScanLayout three = infrared_layout();
  three.beam_count = 3;

  const auto with_cones = NeuroFuzzy::create({}, setup_with(cones));
  const auto with_three = NeuroFuzzy::create({}, setup_with(three));

  ASSERT_FALSE(with_cones.ok());
  EXPECT_EQ(with_cones.error().message,
            "neuro_fuzzy needs four infrared rays, ahead, back, left and right; 'cones' gives 7 "
            "beams that are no infrared, from 45 degrees in steps of -15");
  ASSERT_FALSE(with_three.ok());
  EXPECT_EQ(with_three.error().message,
            "neuro_fuzzy needs four infrared rays, ahead, back, left and right; 'infrared' gives "
            "3 infrared rays, from 90 degrees in steps of -90");
}

}  // namespace
}  // namespace clew::control
