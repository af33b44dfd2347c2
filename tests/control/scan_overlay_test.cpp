// SPDX-License-Identifier: Apache-2.0
#include "control/scan_overlay.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/angle.hpp"

namespace clew::control {
namespace {

using core::radians;

constexpr double kRadius_m = 0.15;

domain::Scan cones() {
  domain::Scan scan;
  scan.bearing_first_rad = radians(45.0);
  scan.bearing_step_rad = radians(-15.0);
  scan.beam_width_rad = radians(15.0);
  scan.range_max_m = 1.5;
  scan.ranges_m.assign(7, 1.5);
  return scan;
}

domain::Guidance box(double x_min_m, double y_min_m, double x_max_m, double y_max_m) {
  domain::Guidance guidance;
  guidance.virtual_obstacles.push_back({x_min_m, y_min_m, x_max_m, y_max_m});
  return guidance;
}

domain::Scan seen(const domain::Guidance& guidance, const core::Pose2& pose, domain::Scan scan) {
  overlay_virtual_obstacles(guidance, pose, kRadius_m, scan);
  return scan;
}

TEST(VirtualObstacles, ShortenTheBeamsThatMeetThem) {
  const domain::Scan scan = seen(box(1, -0.05, 2, 0.05), {0, 0, 0}, cones());

  // Ahead the nearest point is 1 m away; the box ends 2.9 degrees off, within the middle cone.
  EXPECT_NEAR(scan.ranges_m[3], 1.0 - kRadius_m, 1e-12);
  EXPECT_EQ(scan.ranges_m[2], 1.5);
  EXPECT_EQ(scan.ranges_m[4], 1.5);
}

TEST(VirtualObstacles, AreMetAtTheEdgeOfAConeThatDoesNotHoldTheirNearestPoint) {
  const domain::Scan scan = seen(box(1, -5, 2, 5), {0, 0, 0}, cones());

  // As a wall at 1 m: cone 1 reaches it at its edge, 22.5 degrees off the normal.
  EXPECT_NEAR(scan.ranges_m[1], 1.0 / std::cos(radians(22.5)) - kRadius_m, 1e-12);
  EXPECT_NEAR(scan.ranges_m[5], scan.ranges_m[1], 1e-12);
}

TEST(VirtualObstacles, AreMetByRays) {
  domain::Scan rays = cones();
  rays.beam_width_rad = 0.0;

  const domain::Scan scan = seen(box(1, -5, 2, 5), {0, 0, 0}, rays);

  EXPECT_NEAR(scan.ranges_m[3], 1.0 - kRadius_m, 1e-12);
  EXPECT_NEAR(scan.ranges_m[1], 1.0 / std::cos(radians(30.0)) - kRadius_m, 1e-12);
}

TEST(VirtualObstacles, LieInTheOdometryFrame) {
  const domain::Scan scan = seen(box(2.95, 4, 3.05, 5), {3, 3, radians(90.0)}, cones());

  EXPECT_NEAR(scan.ranges_m[3], 1.0 - kRadius_m, 1e-12);
}

TEST(VirtualObstacles, DoNotLengthenReadings) {
  domain::Scan near = cones();
  near.ranges_m[3] = 0.2;

  EXPECT_EQ(seen(box(1, -1, 2, 1), {0, 0, 0}, near).ranges_m[3], 0.2);
}

TEST(VirtualObstacles, BehindTheRobotAreNotSeen) {
  EXPECT_EQ(seen(box(-2, -1, -1, 1), {0, 0, 0}, cones()).ranges_m, cones().ranges_m);
}

TEST(VirtualObstacles, ThatHoldTheRobotAreIgnored) {
  EXPECT_EQ(seen(box(-1, -1, 1, 1), {0, 0, 0}, cones()).ranges_m, cones().ranges_m);
}

TEST(VirtualObstacles, CloserThanTheSkinReadZero) {
  EXPECT_EQ(seen(box(0.1, -1, 1, 1), {0, 0, 0}, cones()).ranges_m[3], 0.0);
}

}  // namespace
}  // namespace clew::control
