// SPDX-License-Identifier: Apache-2.0
#include "sense/laser.hpp"

#include "room.hpp"

namespace clew::sense {
namespace {

using core::radians;

constexpr double kTolerance_m = 1e-9;  // rounding of a few trigonometric functions

TEST(Laser, HasARayEveryHalfDegreeOverTheFrontLeftmostFirst) {
  const Laser laser({}, kRadius_m);

  const domain::Scan scan = measure(laser, make_room(""), {10, 10, 0});

  expect_layout(laser, scan);
  EXPECT_EQ(scan.ranges_m.size(), 361u);
  EXPECT_NEAR(scan.bearing_rad(0), radians(90.0), 1e-12);
  EXPECT_NEAR(scan.bearing_rad(180), 0.0, 1e-12);
  EXPECT_NEAR(scan.bearing_rad(360), radians(-90.0), 1e-12);
}

TEST(Laser, MeasuresFromTheSkinAlongEachRay) {
  const Laser laser({}, kRadius_m);

  const domain::Scan scan = measure(laser, make_room("walls: [[11, 0, 11, 20]]"), {10, 10, 0});

  // The wall is 1 m ahead of the centre; at 60 degrees (ray 60) 2 m, at 70 (ray 40) beyond reach.
  EXPECT_NEAR(scan.ranges_m[180], 1.0 - kRadius_m, kTolerance_m);
  EXPECT_NEAR(scan.ranges_m[60], 2.0 - kRadius_m, kTolerance_m);
  EXPECT_NEAR(scan.ranges_m[300], 2.0 - kRadius_m, kTolerance_m);
  EXPECT_EQ(scan.ranges_m[40], 2.0);
}

TEST(Laser, LooksAllAroundOnRequest) {
  LaserParameters parameters;
  parameters.field_rad = radians(360.0);
  parameters.beams = 5;
  const Laser laser(parameters, kRadius_m);

  const domain::Scan scan = measure(laser, make_room("walls: [[9, 0, 9, 20]]"), {10, 10, 0});

  // Back, left, ahead, right, back.
  EXPECT_NEAR(scan.ranges_m[0], 1.0 - kRadius_m, kTolerance_m);
  EXPECT_EQ(scan.ranges_m[1], 2.0);
  EXPECT_EQ(scan.ranges_m[2], 2.0);
  EXPECT_EQ(scan.ranges_m[3], 2.0);
  EXPECT_NEAR(scan.ranges_m[4], 1.0 - kRadius_m, kTolerance_m);
}

TEST(Laser, HasTheCommonNoise) {
  LaserParameters lossy;
  lossy.noise.drop_out_ratio = 1.0;

  const domain::Scan scan =
      measure(Laser(lossy, kRadius_m), make_room("walls: [[11, 0, 11, 20]]"), {10, 10, 0});

  EXPECT_EQ(scan.ranges_m, std::vector<double>(361, 2.0));
}

}  // namespace
}  // namespace clew::sense
