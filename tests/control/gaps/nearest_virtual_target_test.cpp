// SPDX-License-Identifier: Apache-2.0
#include "control/gaps/nearest_virtual_target.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/angle.hpp"
#include "tests/source_files.hpp"

namespace clew::control {
namespace {

using tests::file_of;

using core::radians;

constexpr double kRadius_m = 0.15;
constexpr double kRange_m = 2.0;
constexpr double kTick_s = 0.1;

NearestVirtualTarget controller(const NearestVirtualTargetParameters& parameters = {}) {
  return {parameters,
          VirtualTargetRules::parse(file_of("configs/rulebases/nakhaeinia_nvt.yaml")).value(),
          kRadius_m, kTick_s};
}

/// A laser's scan of 361 rays over the front, with nothing around.
domain::Scan free_scan() {
  domain::Scan scan;
  scan.bearing_first_rad = radians(90.0);
  scan.bearing_step_rad = radians(-0.5);
  scan.range_max_m = kRange_m;
  scan.ranges_m.assign(361, kRange_m);
  return scan;
}

/// Returns at distance_m over these bearings, from left to right.
domain::Scan scan_with(double left_deg, double right_deg, double distance_m) {
  domain::Scan scan = free_scan();
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double bearing_deg = core::degrees(scan.bearing_rad(i));
    if (bearing_deg <= left_deg + 0.1 && bearing_deg >= right_deg - 0.1) {
      scan.ranges_m[i] = distance_m;
    }
  }
  return scan;
}

domain::Odometry at(double x_m, double y_m, double heading_deg) {
  domain::Odometry odometry;
  odometry.pose_odom_robot = {x_m, y_m, radians(heading_deg)};
  return odometry;
}

TEST(NearestVirtualTarget, GoesStraightToATargetThatNothingHides) {
  const domain::Motion motion = controller().step(at(0, 0, 0), free_scan(), {5, 0});

  EXPECT_EQ(motion.kind, domain::CommandKind::kVelocities);
  EXPECT_EQ(motion.turn_rate_radps, 0.0);
  EXPECT_NEAR(motion.speed_mps, 0.5, 1e-12);  // S and VF: Fast
}

TEST(NearestVirtualTarget, TurnsNoFurtherThanToTheTargetInATick) {
  // 1 degree to the left: 0.1745 rad/s would reach it in a tick; Smooth is 0.6 rad/s.
  const core::Vec2 target(5.0 * core::cos(radians(1.0)), 5.0 * core::sin(radians(1.0)));

  const domain::Motion motion = controller().step(at(0, 0, 0), free_scan(), target);

  EXPECT_NEAR(motion.turn_rate_radps, radians(1.0) / kTick_s, 1e-9);
}

TEST(NearestVirtualTarget, TakesTheGapWithTheShorterPath) {
  // An obstacle 0.85 m before the skin, 1 m from the centre, from 30 to -10 degrees: the way round
  // it on the right is shorter. It keeps 0.21 m from its edge: 10 + asin(0.21) = 22.1 degrees.
  const domain::Motion motion =
      controller().step(at(0, 0, 0), scan_with(30.0, -10.0, 0.85), {5, 0});

  // The first of the nearest returns is 52 degrees off the way: between D and U, so between Large
  // and Medium.
  EXPECT_LT(motion.turn_rate_radps, -1.0);
  EXPECT_GT(motion.speed_mps, 0.1);
}

TEST(NearestVirtualTarget, KeepsItsGapWhereTwoAreAsGood) {
  auto kept = controller();
  kept.step(at(0, 0, 0), scan_with(10.0, -30.0, 0.85), {5, 0});  // goes for the left
  auto fresh = controller();
  // Now the right side is a little shorter: by less than 0.05 m.
  const domain::Scan almost_even = scan_with(16.0, -15.0, 0.85);

  EXPECT_GT(kept.step(at(0, 0, 0), almost_even, {5, 0}).turn_rate_radps, 0.0);
  EXPECT_LT(fresh.step(at(0, 0, 0), almost_even, {5, 0}).turn_rate_radps, 0.0);
}

TEST(NearestVirtualTarget, TakesAWallBeyondTheDepthForNoObstacle) {
  // A wall 1.55 m before the skin over the whole left half: with depth_ratio 0.7 the way is free
  // for the 1.4 m asked for, with 1 it is round the wall's end.
  const domain::Scan wall = scan_with(90.0, -30.0, 1.55);
  NearestVirtualTargetParameters shallow;
  shallow.depth_ratio = 0.7;

  EXPECT_EQ(controller(shallow).step(at(0, 0, 0), wall, {5, 0}).turn_rate_radps, 0.0);
  EXPECT_LT(controller().step(at(0, 0, 0), wall, {5, 0}).turn_rate_radps, 0.0);
}

TEST(NearestVirtualTarget, LeavesAGapTooNarrowForTheRobot) {
  // Returns all around but for a gap ahead: at 1 m from the centre the robot with its clearance
  // needs 2 asin(0.21) = 24 degrees; a gap of 20 leads nowhere, one of 40 leads on.
  domain::Scan narrow = scan_with(90.0, -90.0, 0.85);
  domain::Scan wide = narrow;
  for (std::size_t i = 0; i < narrow.ranges_m.size(); ++i) {
    const double off_deg = std::fabs(core::degrees(narrow.bearing_rad(i)));
    if (off_deg < 10.0) narrow.ranges_m[i] = kRange_m;
    if (off_deg < 20.0) wide.ranges_m[i] = kRange_m;
  }
  auto before_narrow = controller();
  auto before_wide = controller();

  // Through the wide gap it sees a way as deep as the scan; before the narrow one, half as deep is
  // no way either (1 m, of which the disc leaves 0.79), and a quarter is as good everywhere: so it
  // goes on, more slowly, until it is near.
  EXPECT_EQ(before_wide.step(at(0, 0, 0), wide, {5, 0}).turn_rate_radps, 0.0);
  core::StateWriter writer;
  before_narrow.step(at(0, 0, 0), narrow, {5, 0});
  before_narrow.save(writer);
  NearestVirtualTarget::State state;
  core::StateReader reader(writer.bytes());
  reader(state);
  EXPECT_NEAR(core::length(state.virtual_target_odom), 0.5, 1e-12);  // a quarter of the 2 m
}

TEST(NearestVirtualTarget, TurnsOnTheSpotWhereNoDirectionIsFree) {
  const domain::Motion motion = controller().step(at(0, 0, 0), scan_with(90, -90, 0.1), {0, -5});

  EXPECT_EQ(motion.speed_mps, 0.0);
  EXPECT_LT(motion.turn_rate_radps, 0.0);
}

TEST(NearestVirtualTarget, TurnsBeforeItGoesToATargetBehindIt) {
  domain::Scan around = free_scan();
  around.bearing_first_rad = radians(180.0);
  around.bearing_step_rad = radians(-1.0);

  const domain::Motion motion = controller().step(at(0, 0, 0), around, {-5, 1});

  EXPECT_EQ(motion.speed_mps, 0.0);
  EXPECT_GT(motion.turn_rate_radps, 0.0);
}

TEST(NearestVirtualTarget, GoesOnAsBeforeAfterSaveAndLoad) {
  auto first = controller();
  first.step(at(0, 0, 0), scan_with(10.0, -30.0, 0.85), {5, 0});
  core::StateWriter writer;
  first.save(writer);

  auto restored = controller();
  core::StateReader reader(writer.bytes());
  restored.load(reader);

  EXPECT_TRUE(reader.complete());
  EXPECT_GT(restored.step(at(0, 0, 0), scan_with(16.0, -15.0, 0.85), {5, 0}).turn_rate_radps, 0.0);
}

TEST(NearestVirtualTarget, RefusesASensorThatShowsNoGaps) {
  domain::BehaviourSetup setup;
  setup.scan = {"infrared", 4, radians(90.0), radians(-90.0), 0.0, 0.8};

  const auto made = NearestVirtualTarget::create({}, setup);

  ASSERT_FALSE(made.ok());
  EXPECT_EQ(
      made.error().message,
      "nearest_virtual_target needs 2 beams or more, at most 15 degrees unseen between beams, "
      "beams out to 45 degrees on each side; 'infrared' gives 4 beams of 0 degrees, 90 "
      "degrees apart from 90 on");
}

TEST(NearestVirtualTarget, TellsTheVirtualTargetInForceAndNoneOnTheStraightWay) {
  NearestVirtualTarget free = controller();
  NearestVirtualTarget around = controller();
  Controller::VirtualTargets none;
  Controller::VirtualTargets one;

  free.step(at(0, 0, 0), free_scan(), {5, 0});
  free.tell_virtual_targets(none);
  around.step(at(1, 0, 0), scan_with(30, -50, 1.0), {6, 0});
  around.tell_virtual_targets(one);

  EXPECT_EQ(none.size(), 0u);
  // As deep as it sees, on the left of what is in the way.
  ASSERT_EQ(one.size(), 1u);
  EXPECT_NEAR(std::hypot(one[0].x_m - 1.0, one[0].y_m), kRange_m, 1e-9);
  EXPECT_GT(core::degrees(std::atan2(one[0].y_m, one[0].x_m - 1.0)), 30.0);
}

}  // namespace
}  // namespace clew::control
