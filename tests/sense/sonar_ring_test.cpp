// SPDX-License-Identifier: Apache-2.0
#include "sense/sonar_ring.hpp"

#include "room.hpp"

namespace clew::sense {
namespace {

using core::radians;

constexpr double kTolerance_m = 1e-9;

TEST(SonarRing, IsSixteenConesAllAround) {
  const SonarRing ring({}, kRadius_m);

  const domain::Scan scan = measure(ring, make_room(""), {10, 10, 0});

  expect_layout(ring, scan);
  EXPECT_EQ(scan.ranges_m, std::vector<double>(16, 2.54));  // 100 inches
  EXPECT_NEAR(scan.bearing_rad(4), radians(90.0), 1e-12);   // left
  EXPECT_NEAR(scan.bearing_rad(8), 0.0, 1e-12);             // ahead
  EXPECT_NEAR(scan.bearing_rad(12), radians(-90.0), 1e-12);
}

TEST(SonarRing, HearsTheNearestThingInEachCone) {
  // A wall 1 m ahead: the cone at 45 degrees reaches it at its edge, 33.75 degrees.
  const domain::Scan scan =
      measure(SonarRing({}, kRadius_m), make_room("walls: [[11, 0, 11, 20]]"), {10, 10, 0});

  EXPECT_NEAR(scan.ranges_m[8], 1.0 - kRadius_m, kTolerance_m);
  EXPECT_NEAR(scan.ranges_m[6], 1.0 / core::cos(radians(33.75)) - kRadius_m, kTolerance_m);
  EXPECT_NEAR(scan.ranges_m[10], scan.ranges_m[6], kTolerance_m);
  EXPECT_EQ(scan.ranges_m[0], 2.54);
}

TEST(SonarRing, LeavesGapsBetweenNarrowCones) {
  // A pole between two sonars, at 11.25 degrees: cones of 10 degrees end at 5 and begin at 17.5.
  SonarRingParameters narrow;
  narrow.cone_rad = radians(10.0);
  const world::World room = make_room("circles: [[10.980785, 10.195090, 0.01]]");

  EXPECT_EQ(measure(SonarRing(narrow, kRadius_m), room, {10, 10, 0}).ranges_m,
            std::vector<double>(16, 2.54));
  EXPECT_LT(measure(SonarRing({}, kRadius_m), room, {10, 10, 0}).ranges_m[8], 1.0);
}

}  // namespace
}  // namespace clew::sense
