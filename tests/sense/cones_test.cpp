// SPDX-License-Identifier: Apache-2.0
#include "sense/cones.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/random.hpp"

namespace clew::sense {
namespace {

constexpr double kRadius_m = 0.15;
constexpr double kTolerance_m = 1e-9;  // rounding of a few trigonometric functions

world::World make_world(const std::string& obstacles) {
  auto world =
      world::World::parse("format: clew-world/1\nname: test\nbounds: [0, 0, 20, 20]\n" + obstacles +
                              "\nstart: [1, 1, 0]\ntarget: [19, 19]\ntarget_radius: 0.2\n",
                          "test.yaml");
  EXPECT_TRUE(world.ok()) << world.error().text();
  return std::move(world).value();
}

domain::Scan measure(const ConesParameters& parameters, const world::World& world,
                     const core::Pose2& pose, std::uint64_t tick = 0) {
  domain::Scan scan;
  Cones(parameters, kRadius_m).measure(world, pose, 0.0, core::Random({1, 0, 1, tick}), scan);
  return scan;
}

TEST(Cones, AreSevenOverTheFrontLeftmostFirst) {
  const domain::ScanLayout layout = Cones({}, kRadius_m).layout();

  EXPECT_EQ(layout.beam_count, 7u);
  EXPECT_DOUBLE_EQ(layout.bearing_first_rad, core::radians(45.0));
  EXPECT_DOUBLE_EQ(layout.bearing_step_rad, core::radians(-15.0));
  EXPECT_DOUBLE_EQ(layout.beam_width_rad, core::radians(15.0));
  EXPECT_DOUBLE_EQ(layout.range_max_m, 1.5);
}

TEST(Cones, ScanHasTheLayoutThatWasPromised) {
  const domain::Scan scan = measure({}, make_world(""), {10, 10, 0});
  const domain::ScanLayout layout = Cones({}, kRadius_m).layout();

  EXPECT_EQ(scan.ranges_m.size(), layout.beam_count);
  EXPECT_EQ(scan.bearing_first_rad, layout.bearing_first_rad);
  EXPECT_EQ(scan.bearing_step_rad, layout.bearing_step_rad);
  EXPECT_EQ(scan.beam_width_rad, layout.beam_width_rad);
  EXPECT_EQ(scan.range_max_m, layout.range_max_m);
}

TEST(Cones, ReadTheRangeWhereNothingIsNear) {
  for (const double range_m : measure({}, make_world(""), {10, 10, 0}).ranges_m) {
    EXPECT_EQ(range_m, 1.5);
  }
}

TEST(Cones, MeasureFromTheSkin) {
  const domain::Scan scan = measure({}, make_world("walls: [[11, 0, 11, 20]]"), {10, 10, 0});

  // The wall is 1 m before the centre. A cone centred at b reaches it at its edge nearest to the
  // normal, |b| - 7.5 degrees: 1 / cos(7.5), 1 / cos(22.5), 1 / cos(37.5), less the radius.
  EXPECT_NEAR(scan.ranges_m[3], 1.0 - kRadius_m, kTolerance_m);
  EXPECT_NEAR(scan.ranges_m[2], 1.0 / std::cos(core::radians(7.5)) - kRadius_m, kTolerance_m);
  EXPECT_NEAR(scan.ranges_m[1], 1.0 / std::cos(core::radians(22.5)) - kRadius_m, kTolerance_m);
  EXPECT_NEAR(scan.ranges_m[0], 1.0 / std::cos(core::radians(37.5)) - kRadius_m, kTolerance_m);
  EXPECT_NEAR(scan.ranges_m[6], scan.ranges_m[0], kTolerance_m);
}

TEST(Cones, ReportTheNearestThingInTheConeAndNotTheMiddleOfIt) {
  // A pole of 0.1 m whose centre is 1 m away, 50 degrees to the left: in cone 0 (37.5 to 52.5).
  const double angle_rad = core::radians(50.0);
  const std::string pole = "circles: [[" + std::to_string(10.0 + std::cos(angle_rad)) + ", " +
                           std::to_string(10.0 + std::sin(angle_rad)) + ", 0.1]]";

  const domain::Scan scan = measure({}, make_world(pole), {10, 10, 0});

  EXPECT_NEAR(scan.ranges_m[0], 0.9 - kRadius_m, 1e-5);  // std::to_string gives six decimals
  EXPECT_EQ(scan.ranges_m[1], 1.5);
}

TEST(Cones, TurnWithTheRobot) {
  const world::World world = make_world("walls: [[0, 11, 20, 11]]");

  const domain::Scan scan = measure({}, world, {10, 10, core::radians(45.0)});

  // The wall is on the left of a robot that heads 45 degrees toward it: straight ahead of cone 0.
  EXPECT_NEAR(scan.ranges_m[0], 1.0 - kRadius_m, kTolerance_m);
  EXPECT_EQ(scan.ranges_m[6], 1.5);
}

TEST(Cones, ReadZeroAtContact) {
  const domain::Scan scan = measure({}, make_world("walls: [[10.1, 0, 10.1, 20]]"), {10, 10, 0});

  EXPECT_EQ(scan.ranges_m[3], 0.0);
}

TEST(Cones, AddNoiseThatIsAFunctionOfTheTick) {
  ConesParameters noisy;
  noisy.noise.stddev_m = 0.05;
  const world::World world = make_world("walls: [[11, 0, 11, 20]]");

  const domain::Scan first = measure(noisy, world, {10, 10, 0}, 7);
  const domain::Scan again = measure(noisy, world, {10, 10, 0}, 7);
  const domain::Scan later = measure(noisy, world, {10, 10, 0}, 8);

  EXPECT_EQ(first.ranges_m, again.ranges_m);
  EXPECT_NE(first.ranges_m, later.ranges_m);
}

TEST(Cones, NoiseHasTheStandardDeviationAskedFor) {
  ConesParameters noisy;
  noisy.noise.stddev_m = 0.05;
  const world::World world = make_world("walls: [[11, 0, 11, 20]]");
  constexpr int kScans = 4000;
  double sum_m = 0.0;
  double squares_m2 = 0.0;

  for (int tick = 0; tick < kScans; ++tick) {
    const double error_m =
        measure(noisy, world, {10, 10, 0}, static_cast<std::uint64_t>(tick)).ranges_m[3] -
        (1.0 - kRadius_m);
    sum_m += error_m;
    squares_m2 += error_m * error_m;
  }

  // Five standard errors: 0.05 / sqrt(4000) of the mean, 0.05 / sqrt(8000) of the deviation.
  EXPECT_NEAR(sum_m / kScans, 0.0, 0.004);
  EXPECT_NEAR(std::sqrt(squares_m2 / kScans), 0.05, 0.003);
}

TEST(Cones, ClipNoisyReadingsToTheRange) {
  ConesParameters noisy;
  noisy.noise.stddev_m = 1.0;
  const world::World world = make_world("walls: [[11, 0, 11, 20]]");

  for (std::uint64_t tick = 0; tick < 100; ++tick) {
    for (const double range_m : measure(noisy, world, {10, 10, 0}, tick).ranges_m) {
      EXPECT_GE(range_m, 0.0);
      EXPECT_LE(range_m, 1.5);
    }
  }
}

TEST(Cones, LoseTheShareOfReadingsAskedFor) {
  ConesParameters lossy;
  lossy.noise.drop_out_ratio = 0.25;
  const world::World world = make_world("walls: [[11, 0, 11, 20]]");
  constexpr int kScans = 4000;
  int lost = 0;

  for (int tick = 0; tick < kScans; ++tick) {
    if (measure(lossy, world, {10, 10, 0}, static_cast<std::uint64_t>(tick)).ranges_m[3] == 1.5) {
      ++lost;
    }
  }

  // Five standard errors of a share of 0.25 of 4000: 0.034.
  EXPECT_NEAR(static_cast<double>(lost) / kScans, 0.25, 0.035);
}

TEST(Cones, LengthenReadingsInACornerOnRequest) {
  // The corner is 1 m ahead on the bisector of two walls at a right angle.
  const world::World world = make_world("walls: [[11, 10, 9, 12], [11, 10, 9, 8]]");
  ConesParameters echoing;
  echoing.corner_echo_ratio = 0.2;

  const double plain_m = measure({}, world, {10, 10, 0}).ranges_m[3];
  const double echo_m = measure(echoing, world, {10, 10, 0}).ranges_m[3];

  // The walls enter the cone at its edges: sin 45 / sin(45 + 7.5) = 0.891 of the distance.
  EXPECT_NEAR(plain_m, std::sin(core::radians(45.0)) / std::sin(core::radians(52.5)) - kRadius_m,
              kTolerance_m);
  EXPECT_NEAR(echo_m, 1.2 - kRadius_m, kTolerance_m);
}

TEST(Cones, HearNoCornerBehindAnObstacle) {
  const world::World world =
      make_world("walls: [[11, 10, 9, 12], [11, 10, 9, 8]]\ncircles: [[10.45, 10, 0.05]]");
  ConesParameters echoing;
  echoing.corner_echo_ratio = 0.2;

  EXPECT_NEAR(measure(echoing, world, {10, 10, 0}).ranges_m[3], 0.4 - kRadius_m, kTolerance_m);
}

}  // namespace
}  // namespace clew::sense
