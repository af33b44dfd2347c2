// SPDX-License-Identifier: Apache-2.0
#include "ros2/conversions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math.hpp"
#include "ros2/run_markers.hpp"

namespace clew::ros2 {
namespace {

Frames frames() { return Frames::of(Names("", {})); }

TEST(LaserScanOfAScan, AddsTheRadiusAndCallsNothingInfinite) {
  domain::Scan scan;
  scan.stamp.sim_time_s = 1.5;
  scan.bearing_first_rad = -0.5;
  scan.bearing_step_rad = 0.5;
  scan.range_max_m = 2.0;
  scan.ranges_m = {0.25, 2.0, 1.0};

  const LaserScan out = to_laser_scan(scan, frames(), 0.25, 0.5);

  EXPECT_EQ(out.header.stamp.sec, 1);
  EXPECT_EQ(out.header.stamp.nanosec, 500000000U);
  EXPECT_EQ(out.header.frame_id, "laser");
  EXPECT_FLOAT_EQ(out.angle_min, -0.5F);
  EXPECT_FLOAT_EQ(out.angle_max, 0.5F);
  EXPECT_FLOAT_EQ(out.angle_increment, 0.5F);
  EXPECT_FLOAT_EQ(out.range_min, 0.25F);
  EXPECT_FLOAT_EQ(out.range_max, 2.25F);
  ASSERT_EQ(out.ranges.size(), 3U);
  EXPECT_FLOAT_EQ(out.ranges[0], 0.5F);
  EXPECT_TRUE(std::isinf(out.ranges[1]));
  EXPECT_FLOAT_EQ(out.ranges[2], 1.25F);
}

TEST(LaserScanOfAScan, TurnsClockwiseBeamsAround) {
  domain::Scan scan;
  scan.bearing_first_rad = 1.0;
  scan.bearing_step_rad = -1.0;
  scan.range_max_m = 9.0;
  scan.ranges_m = {1.0, 2.0, 3.0};

  const LaserScan out = to_laser_scan(scan, frames(), 0.0, 0.1);

  EXPECT_FLOAT_EQ(out.angle_min, -1.0F);
  EXPECT_FLOAT_EQ(out.angle_max, 1.0F);
  EXPECT_FLOAT_EQ(out.ranges[0], 3.0F);
  EXPECT_FLOAT_EQ(out.ranges[2], 1.0F);
}

TEST(OdomInMap, TakesTheRobotsPlaceInOneFrameToThatInTheOther) {
  const core::Pose2 in_map{3.0, -1.0, 2.0};
  const core::Pose2 in_odom{0.7, 0.4, -2.5};

  const core::Pose2 odom = odom_in_map(in_map, in_odom);

  // Composed with the robot's pose in odom it is the pose in map again.
  const double c = std::cos(odom.heading_rad);
  const double s = std::sin(odom.heading_rad);
  EXPECT_NEAR(odom.x_m + c * in_odom.x_m - s * in_odom.y_m, in_map.x_m, 1e-12);
  EXPECT_NEAR(odom.y_m + s * in_odom.x_m + c * in_odom.y_m, in_map.y_m, 1e-12);
  EXPECT_NEAR(
      std::remainder(odom.heading_rad + in_odom.heading_rad - in_map.heading_rad, 2.0 * core::kPi),
      0.0, 1e-12);
}

TEST(GridOfAWorld, HasObstaclesWhereTheyAreAndNoMoreCellsThanAllowed) {
  const auto world = world::World::parse(
      "format: clew-world/1\nname: w\nbounds: [0, 0, 4, 2]\nstart: [0.5, 0.5, 0]\n"
      "target: [3.5, 1.5]\ntarget_radius: 0.2\nwalls: [[2, 0, 2, 1]]\n",
      "w.yaml");
  ASSERT_TRUE(world.ok()) << world.error().text();

  const OccupancyGrid fine = to_grid(*world, frames(), 0.1, 10000);
  const OccupancyGrid coarse = to_grid(*world, frames(), 0.1, 100);

  EXPECT_EQ(fine.info.width, 40U);
  EXPECT_EQ(fine.info.height, 20U);
  EXPECT_EQ(fine.data.size(), 800U);
  EXPECT_EQ(fine.data[5 * 40 + 20], 100);  // at (2.05, 0.55), on the wall
  EXPECT_EQ(fine.data[15 * 40 + 20], 0);   // above its end
  EXPECT_EQ(fine.data[5 * 40 + 10], 0);    // in the open
  EXPECT_LE(coarse.data.size(), 100U);
  EXPECT_FLOAT_EQ(coarse.info.resolution, 0.4F);
}

TEST(RunMarkers, KeepsTheLastHundredOfAKindAndDeletesTheRest) {
  RunMarkers markers(frames());
  domain::EventEntry trap;
  trap.kind = domain::EventKind::kTrap;
  for (int i = 0; i < 150; ++i) {
    trap.x_m = i;
    markers.add({}, trap);
  }
  trap.kind = domain::EventKind::kEscapeBegun;
  markers.add({}, trap);

  ASSERT_TRUE(markers.changed());
  const MarkerArray all = markers.all();

  EXPECT_FALSE(markers.changed());
  ASSERT_EQ(all.markers.size(), 1U + RunMarkers::kMostOfAKind);
  EXPECT_EQ(all.markers[0].action, Marker::kDeleteAll);
  EXPECT_EQ(all.markers[1].pose.position.x, 50.0);
  EXPECT_EQ(all.markers.back().pose.position.x, 149.0);
  EXPECT_EQ(all.markers[1].header.frame_id, "odom");
}

}  // namespace
}  // namespace clew::ros2
