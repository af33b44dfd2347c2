// SPDX-License-Identifier: Apache-2.0
#include "map/scan_evidence.hpp"

#include <gtest/gtest.h>

#include "core/angle.hpp"

namespace clew::map {
namespace {

constexpr double kRadius_m = 0.15;
constexpr double kCell_m = 0.025;

/// A robot of radius 0.15 m with seven cones, or with a laser.
class ScanEvidenceTest : public ::testing::Test {
 protected:
  ScanEvidenceTest() {
    scan_.bearing_first_rad = core::radians(45.0);
    scan_.bearing_step_rad = core::radians(-15.0);
    scan_.beam_width_rad = core::radians(15.0);
    scan_.range_max_m = 1.5;
    scan_.ranges_m.assign(7, 1.5);
  }

  void use_laser() {
    scan_.bearing_first_rad = core::radians(90.0);
    scan_.bearing_step_rad = core::radians(-0.5);
    scan_.beam_width_rad = 0.0;
    scan_.ranges_m.assign(361, 1.5);
  }
  void stand(double x_m, double y_m, double heading_deg) {
    odometry_.pose_odom_robot = {x_m, y_m, core::radians(heading_deg)};
  }
  void mark() { evidence_.mark(odometry_, scan_, seen_); }
  int obstacles(Mark wanted) const {
    int count = 0;
    seen_.for_each(wanted, {-10, -10}, {10, 10}, [&](const Vec2&) { ++count; });
    return count;
  }

  domain::Odometry odometry_;
  domain::Scan scan_;
  ScanEvidence evidence_{{}, kRadius_m};
  SeenMap seen_{kCell_m, 1000};
};

TEST_F(ScanEvidenceTest, AReadingIsFreeUpToItsArcAlsoBetweenTwoCones) {
  mark();

  // Nothing within 1.5 m of the skin: 1.65 m from the centre; 7.5 degrees is a border of cones.
  for (const double bearing_deg : {0.0, 7.5, -22.5, 45.0}) {
    const Vec2 way = core::direction(core::radians(bearing_deg));
    for (const double at_m : {0.3, 1.0, 1.6}) {
      EXPECT_TRUE(seen_.is(Mark::kFree, at_m * way)) << bearing_deg << ' ' << at_m;
    }
    EXPECT_FALSE(seen_.is(Mark::kFree, 1.7 * way));
  }
  EXPECT_FALSE(seen_.is(Mark::kFree, {-0.5, 0.0}));  // behind
  EXPECT_TRUE(seen_.is(Mark::kFree, {-0.1, 0.0}));   // the body itself
  EXPECT_EQ(obstacles(Mark::kHit) + obstacles(Mark::kSuspected), 0);
}

TEST_F(ScanEvidenceTest, AFarArcIsSuspectedAndANearOneHits) {
  scan_.ranges_m[3] = 1.0;  // 1.15 m x 15 degrees = 0.30 m of arc
  mark();

  EXPECT_TRUE(seen_.is(Mark::kSuspected, {1.15, 0.0}));
  EXPECT_TRUE(seen_.is(Mark::kSuspected, 1.15 * core::direction(core::radians(6.0))));
  EXPECT_EQ(obstacles(Mark::kHit), 0);

  stand(0.0, 5.0, 0.0);
  scan_.ranges_m[3] = 0.2;  // 0.35 m x 15 degrees = 0.09 m
  mark();

  EXPECT_TRUE(seen_.is(Mark::kHit, {0.35, 5.0}));
  EXPECT_EQ(obstacles(Mark::kHit), 1);
}

TEST_F(ScanEvidenceTest, WhatWasSeenFreeIsTakenOffAnArc) {
  // From (1, -2) looking up, the cones see the right half of the later arc free.
  stand(1.15, -1.2, 90.0);
  scan_.ranges_m.assign(7, 1.05);  // free up to 1.2 m: the line y = 0
  mark();
  const int suspected_before = obstacles(Mark::kSuspected);
  stand(0.0, 0.0, 0.0);
  scan_.ranges_m.assign(7, 1.5);
  scan_.ranges_m[3] = 1.0;
  mark();

  // The arc at 1.15 m from -7.5 to 7.5 degrees; what lies more than a cell below y = 0 is free.
  EXPECT_GT(suspected_before, 0);
  EXPECT_TRUE(seen_.is(Mark::kSuspected, 1.15 * core::direction(core::radians(6.0))));
  EXPECT_TRUE(seen_.is(Mark::kFree, 1.15 * core::direction(core::radians(-6.0))));
}

TEST_F(ScanEvidenceTest, AnObstacleThatCameLaterIsTaken) {
  mark();
  scan_.ranges_m[3] = 1.0;

  mark();

  EXPECT_TRUE(seen_.is(Mark::kSuspected, {1.15, 0.0}));
}

TEST_F(ScanEvidenceTest, RaysHitAndSeeFreeBetweenThem) {
  use_laser();
  scan_.ranges_m[180] = 1.0;  // ahead

  mark();

  EXPECT_TRUE(seen_.is(Mark::kHit, {1.15, 0.0}));
  EXPECT_EQ(obstacles(Mark::kHit), 1);
  EXPECT_TRUE(seen_.is(Mark::kFree, 1.5 * core::direction(core::radians(60.0))));
  EXPECT_TRUE(seen_.is(Mark::kFree, {1.0, 0.0}));
}

TEST_F(ScanEvidenceTest, WhatOutliersLeaveNearTheRobotIsSeenFreeByTheNextScan) {
  use_laser();
  // One ray in ten within 60 degrees of the heading, from 0.05 to 0.8 m beyond the skin.
  for (std::size_t i = 60; i <= 300; i += 10) {
    scan_.ranges_m[i] = 0.05 + 0.03 * static_cast<double>((i - 60) / 10);
  }
  mark();
  EXPECT_EQ(obstacles(Mark::kHit), 25);

  scan_.ranges_m.assign(361, 1.5);
  mark();

  EXPECT_EQ(obstacles(Mark::kHit), 0);
}

/// At 3.9 m rays are 34 mm apart: the end of a wall, or one that they graze, fits between two.
TEST_F(ScanEvidenceTest, WhatLiesBetweenTwoRaysIsNotGone) {
  use_laser();
  scan_.range_max_m = 4.0;
  scan_.ranges_m.assign(361, 4.0);
  stand(0.0, 0.0, -0.0673);  // rays 4.6 mm below and 29.5 mm above the axis, there
  const Vec2 between(3.9125, 0.0125);
  const Vec2 on_a_ray(3.9125, -0.0125);
  seen_.mark_hit(between);
  seen_.mark_hit(on_a_ray);

  mark();

  EXPECT_TRUE(seen_.is(Mark::kHit, between));
  EXPECT_TRUE(seen_.is(Mark::kFree, on_a_ray));
}

TEST_F(ScanEvidenceTest, RaysFarApartTellNothingOfWhatIsBetween) {
  scan_.bearing_first_rad = core::radians(90.0);
  scan_.bearing_step_rad = core::radians(-90.0);
  scan_.beam_width_rad = 0.0;
  scan_.ranges_m.assign(4, 1.5);
  scan_.ranges_m[1] = 0.5;

  mark();

  EXPECT_TRUE(seen_.is(Mark::kHit, {0.65, 0.0}));
  EXPECT_FALSE(seen_.is(Mark::kFree, {0.4, 0.3}));
}

TEST_F(ScanEvidenceTest, AContactIsAHitOnTheSkin) {
  stand(1.0, 2.0, 90.0);
  odometry_.blocked = true;
  odometry_.contact_bearings_rad.push_back(core::radians(-90.0));

  mark();

  // On the right of a robot that looks up: towards x.
  EXPECT_TRUE(seen_.is(Mark::kHit, {1.155, 2.0}));
}

}  // namespace
}  // namespace clew::map
