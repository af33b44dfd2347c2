// SPDX-License-Identifier: Apache-2.0
#include "scan/safe_regions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "core/random.hpp"

namespace clew::scan {
namespace {

using core::degrees;
using core::radians;

constexpr double kRadius_m = 0.15;
constexpr double kClearance_m = 0.05;

/// Rays a degree apart, counter-clockwise from `first_deg`, that see 2 m from the skin.
domain::Scan rays(double first_deg, std::size_t count) {
  domain::Scan scan;
  scan.bearing_first_rad = radians(first_deg);
  scan.bearing_step_rad = radians(1.0);
  scan.range_max_m = 2.0;
  scan.ranges_m.assign(count, 2.0);
  return scan;
}

domain::Scan half_circle() { return rays(-90.0, 181); }

/// A return at a distance from the robot's centre.
void put(domain::Scan& scan, double bearing_deg, double distance_m) {
  const double first_deg = degrees(scan.bearing_first_rad);
  const auto i = static_cast<std::size_t>(std::lround(bearing_deg - first_deg));
  scan.ranges_m[i] = distance_m - kRadius_m;
}

std::vector<SafeRegion> regions_of(const domain::Scan& scan, double depth_m) {
  SafeRegions finder(kRadius_m, kClearance_m);
  finder.update(scan);
  std::vector<SafeRegion> regions;
  finder.find(depth_m, regions);
  return regions;
}

TEST(SafeRegions, AreOneWhereNothingIsSeen) {
  const auto regions = regions_of(half_circle(), 2.0);

  ASSERT_EQ(regions.size(), 1u);
  EXPECT_NEAR(degrees(regions[0].right_rad), -90.0, 1e-9);
  EXPECT_NEAR(degrees(regions[0].width_rad), 180.0, 1e-9);
  EXPECT_EQ(regions[0].depth_m, 2.0);
}

TEST(SafeRegions, LieBetweenReturnsThatLeaveRoom) {
  domain::Scan scan = half_circle();
  put(scan, -30.0, 1.0);
  put(scan, 30.0, 1.0);

  const auto regions = regions_of(scan, 1.5);

  // Each post takes asin(0.2 / 1) = 11.5 degrees on both sides: 19 to 41 are not free.
  ASSERT_EQ(regions.size(), 3u);
  EXPECT_NEAR(degrees(regions[0].width_rad), 48.0, 1e-9);
  EXPECT_NEAR(degrees(regions[1].right_rad), -18.0, 1e-9);
  EXPECT_NEAR(degrees(regions[1].width_rad), 36.0, 1e-9);
  EXPECT_NEAR(degrees(regions[2].right_rad), 42.0, 1e-9);
}

TEST(SafeRegions, AreNotWhereTheGapIsTooNarrow) {
  domain::Scan scan = half_circle();
  // 2 sin 11 = 0.38 m apart, and the disc with its clearance is 0.4 m wide.
  put(scan, -11.0, 1.0);
  put(scan, 11.0, 1.0);

  const auto regions = regions_of(scan, 1.5);

  ASSERT_EQ(regions.size(), 2u);
  EXPECT_NEAR(degrees(regions[0].right_rad + regions[0].width_rad), -23.0, 1e-9);
  EXPECT_NEAR(degrees(regions[1].right_rad), 23.0, 1e-9);
}

TEST(SafeRegions, AreDeepAsFarAsTheNearestReturn) {
  domain::Scan scan = half_circle();
  put(scan, 0.0, 1.2);

  // The disc of 0.2 m stops after 1.2 m - 0.2 m.
  EXPECT_EQ(regions_of(scan, 1.01).size(), 2u);
  EXPECT_EQ(regions_of(scan, 0.99).size(), 1u);
}

TEST(SafeRegions, GoOnBehindTheRobotOnAFullCircle) {
  domain::Scan scan = rays(-180.0, 361);  // the last ray is the first one again
  put(scan, 0.0, 1.0);

  const auto regions = regions_of(scan, 1.5);

  ASSERT_EQ(regions.size(), 1u);
  EXPECT_NEAR(degrees(regions[0].right_rad), 12.0, 1e-9);
  EXPECT_NEAR(degrees(regions[0].width_rad), 336.0, 1e-9);
}

TEST(SafeRegions, AreTheSameWhicheverWayTheBeamsRun) {
  domain::Scan scan = half_circle();
  put(scan, -30.0, 1.0);
  domain::Scan reversed = scan;
  std::reverse(reversed.ranges_m.begin(), reversed.ranges_m.end());
  reversed.bearing_first_rad = radians(90.0);
  reversed.bearing_step_rad = radians(-1.0);

  const auto regions = regions_of(scan, 1.5);
  const auto same = regions_of(reversed, 1.5);

  ASSERT_EQ(same.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(same[i].right_rad, regions[i].right_rad, 1e-12);
    EXPECT_NEAR(same[i].width_rad, regions[i].width_rad, 1e-12);
  }
}

TEST(SafeRegions, TakeAReturnToBeAnywhereOnItsBeam) {
  domain::Scan cones;
  cones.bearing_first_rad = radians(45.0);
  cones.bearing_step_rad = radians(-15.0);
  cones.beam_width_rad = radians(15.0);
  cones.range_max_m = 1.5;
  cones.ranges_m.assign(7, 1.5);
  cones.ranges_m[3] = 1.25;  // ahead, 1.4 m from the centre

  // asin(0.2 / 1.4) = 8.2 degrees beside the cone's edge at 7.5: the cones at 15 are not free.
  const auto regions = regions_of(cones, 1.3);

  ASSERT_EQ(regions.size(), 2u);
  EXPECT_NEAR(degrees(regions[0].right_rad), -45.0, 1e-9);
  EXPECT_NEAR(degrees(regions[0].width_rad), 15.0, 1e-9);
  EXPECT_NEAR(degrees(regions[1].right_rad), 30.0, 1e-9);
}

TEST(SafeRegions, HaveNoDirectionBeforeTheFirstScan) {
  const SafeRegions finder(kRadius_m, kClearance_m);
  std::vector<SafeRegion> regions(1);

  finder.find(1.0, regions);

  EXPECT_EQ(finder.size(), 0u);
  EXPECT_TRUE(regions.empty());
}

// The definition, return by return and direction by direction.
TEST(SafeRegions, FreeDirectionsAreThoseOfTheDefinition) {
  const core::Random random(core::RandomKey{7, 0, 0, 0});
  std::uint32_t next = 0;
  SafeRegions finder(kRadius_m, kClearance_m);
  for (int round = 0; round < 60; ++round) {
    const bool circle = round % 2 == 0;
    domain::Scan scan = circle ? rays(-180.0, 360) : half_circle();
    scan.beam_width_rad = radians(4.0 * random.uniform(next++));
    for (double& range_m : scan.ranges_m) {
      if (random.uniform(next++) < 0.05) range_m = 2.0 * random.uniform(next++);
    }

    finder.update(scan);

    ASSERT_EQ(finder.size(), scan.ranges_m.size());
    for (std::size_t j = 0; j < finder.size(); ++j) {
      double expected_m = scan.range_max_m;
      for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
        if (scan.ranges_m[i] >= scan.range_max_m) continue;
        const double d_m = scan.ranges_m[i] + kRadius_m;
        const double off_rad =
            std::fabs(core::wrap_angle_rad(scan.bearing_rad(i) - finder.bearing_rad(j))) -
            0.5 * scan.beam_width_rad;
        const double half_rad = d_m <= 0.2 ? radians(90.0) : core::asin(0.2 / d_m);
        if (off_rad < half_rad) expected_m = std::min(expected_m, std::max(0.0, d_m - 0.2));
      }
      ASSERT_NEAR(finder.free_m(j), expected_m, 1e-12) << "round " << round << ", " << j;
    }
  }
}

TEST(SafeRegion, GivesItsDirectionNearestToAnother) {
  const SafeRegion ahead{radians(-18.0), radians(36.0), 2.0};
  const SafeRegion behind{radians(170.0), radians(20.0), 2.0};

  EXPECT_NEAR(degrees(ahead.nearest_rad(radians(5.0))), 5.0, 1e-9);
  EXPECT_NEAR(degrees(ahead.nearest_rad(radians(100.0))), 18.0, 1e-9);
  EXPECT_NEAR(degrees(behind.nearest_rad(radians(-100.0))), -170.0, 1e-9);
}

}  // namespace
}  // namespace clew::scan
