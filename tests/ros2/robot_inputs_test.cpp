// SPDX-License-Identifier: Apache-2.0
#include "ros2/robot_inputs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/math.hpp"
#include "domain/topics.hpp"
#include "ros2/conversions.hpp"

namespace clew::ros2 {
namespace {

/// Three cones of 30 degrees: left, ahead, right.
domain::ScanLayout cones() {
  domain::ScanLayout layout;
  layout.sensor = "cones";
  layout.beam_count = 3;
  layout.bearing_first_rad = core::kPi / 6.0;
  layout.bearing_step_rad = -core::kPi / 6.0;
  layout.beam_width_rad = core::kPi / 6.0;
  layout.range_max_m = 2.0;
  return layout;
}

/// A laser all around with a ray a degree, which sees nothing.
LaserScan laser() {
  LaserScan scan;
  scan.angle_min = static_cast<float>(-core::kPi);
  scan.angle_increment = static_cast<float>(core::kPi / 180.0);
  scan.range_min = 0.1F;
  scan.range_max = 10.0F;
  scan.ranges.assign(360, std::numeric_limits<float>::infinity());
  return scan;
}
float& ray(LaserScan& scan, int degrees) {
  return scan.ranges[static_cast<std::size_t>(degrees + 180)];
}

TEST(ScanOfALaser, EachBeamReadsTheNearestReturnWithinItsOpening) {
  LaserScan scan = laser();
  ray(scan, 10) = 1.5F;
  ray(scan, -12) = 1.0F;
  ray(scan, 40) = 0.75F;
  ray(scan, 60) = 0.5F;  // beyond the left cone

  const auto out = to_scan(scan, {}, cones(), 0.25);

  ASSERT_TRUE(out.ok());
  EXPECT_NEAR(out->ranges_m[0], 0.5, 1e-6);
  EXPECT_NEAR(out->ranges_m[1], 0.75, 1e-6);
  EXPECT_EQ(out->ranges_m[2], 2.0);
  EXPECT_TRUE(domain::validate(*out).ok());
}

TEST(ScanOfALaser, WhatIsNoReturnIsNothing) {
  LaserScan scan = laser();
  ray(scan, 0) = NAN;
  ray(scan, 1) = 0.05F;  // below its least range
  ray(scan, 2) = 11.0F;  // above its greatest
  ray(scan, 3) = -std::numeric_limits<float>::infinity();
  ray(scan, 4) = 9.0F;  // a return, beyond what the cones see

  const auto out = to_scan(scan, {}, cones(), 0.25);

  ASSERT_TRUE(out.ok());
  for (const double range_m : out->ranges_m) EXPECT_EQ(range_m, 2.0);
}

TEST(ScanOfALaser, MeasuredNothingIfNoBeamSaysAnything) {
  EXPECT_TRUE(measured_anything(laser()));  // all around is nothing, which is something to know
  LaserScan blind = laser();
  blind.ranges.assign(360, 0.0F);
  ray(blind, 1) = NAN;
  EXPECT_FALSE(measured_anything(blind));
  ray(blind, 2) = 1.0F;
  EXPECT_TRUE(measured_anything(blind));
  blind.ranges.clear();
  EXPECT_FALSE(measured_anything(blind));
}

TEST(ScanOfALaser, TakesIntoAccountWhereTheLaserStands) {
  LaserScan scan = laser();
  ray(scan, 0) = 1.0F;

  // Half a metre ahead of the centre, looking to the left: its x axis is the robot's y axis.
  const auto out = to_scan(scan, {0.5, 0.0, core::kPi / 2.0}, cones(), 0.25);

  // The return lies at (0.5, 1), at 63 degrees: beyond the left cone.
  ASSERT_TRUE(out.ok());
  EXPECT_EQ(out->ranges_m[0], 2.0);
  scan.ranges[180] = 0.2887F;  // at (0.5, 0.2887), at 30 degrees
  const auto nearer = to_scan(scan, {0.5, 0.0, core::kPi / 2.0}, cones(), 0.25);
  ASSERT_TRUE(nearer.ok());
  EXPECT_NEAR(nearer->ranges_m[0], std::hypot(0.5, 0.2887) - 0.25, 1e-4);
}

TEST(ScanOfALaser, IsThatOfTheSensorAgainIfTheLaserIsOneOfOurs) {
  domain::Scan scan;
  scan.bearing_first_rad = cones().bearing_first_rad;
  scan.bearing_step_rad = cones().bearing_step_rad;
  scan.beam_width_rad = cones().beam_width_rad;
  scan.range_max_m = 2.0;
  scan.ranges_m = {0.3, 2.0, 1.1};

  const auto out = to_scan(to_laser_scan(scan, {}, 0.25, 0.1), {}, cones(), 0.25);

  ASSERT_TRUE(out.ok());
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(out->ranges_m[i], scan.ranges_m[i], 1e-6);
}

TEST(ScanOfALaser, AFanThatIsNoneIsRefused) {
  LaserScan scan = laser();
  scan.angle_increment = NAN;
  EXPECT_FALSE(to_scan(scan, {}, cones(), 0.25).ok());
  scan.angle_increment = 1.0F;  // 360 radians around
  EXPECT_FALSE(to_scan(scan, {}, cones(), 0.25).ok());
}

TEST(OdometryOfARobot, AddsUpItsPath) {
  OdometryInput input;
  Odometry message;
  message.pose.pose = to_pose({1.0, 2.0, -3.0});
  message.twist.twist.linear.x = 0.4;
  message.twist.twist.angular.z = -0.2;

  ASSERT_TRUE(input.next(message).ok());
  message.pose.pose = to_pose({1.3, 2.4, 3.0});
  const auto second = input.next(message);

  ASSERT_TRUE(second.ok());
  EXPECT_NEAR(second->pose_odom_robot.heading_rad, 3.0, 1e-12);
  EXPECT_NEAR(second->travel_m, 0.5, 1e-12);
  EXPECT_EQ(second->speed_mps, 0.4);
  EXPECT_EQ(second->turn_rate_radps, -0.2);
}

TEST(OdometryOfARobot, APoseThatIsNoneIsRefused) {
  OdometryInput input;
  Odometry message;
  message.pose.pose.orientation = {0.0, 0.0, 0.0, 0.0};
  EXPECT_FALSE(input.next(message).ok());
  message.pose.pose = to_pose({NAN, 0.0, 0.0});
  EXPECT_FALSE(input.next(message).ok());
}

TEST(OdometryOfARobot, KeepsItsCovarianceOnThePlane) {
  OdometryInput input;
  Odometry message;
  message.pose.covariance[0] = 0.04;
  message.pose.covariance[1] = -0.01;
  message.pose.covariance[7] = 0.09;
  message.pose.covariance[35] = 0.25;

  const auto odometry = input.next(message);

  ASSERT_TRUE(odometry.ok());
  EXPECT_EQ(odometry->covariance.x_m2, 0.04);
  EXPECT_EQ(odometry->covariance.xy_m2, -0.01);
  EXPECT_EQ(odometry->covariance.y_m2, 0.09);
  EXPECT_EQ(odometry->covariance.heading_rad2, 0.25);
  EXPECT_EQ(input.covariance_fault(), "");
}

TEST(OdometryOfARobot, ACovarianceThatIsNoneIsToldWithItsPlaceAndLeftOut) {
  OdometryInput input;
  Odometry message;
  message.pose.covariance[0] = 0.04;
  message.pose.covariance[7] = -1.0;
  auto odometry = input.next(message);
  ASSERT_TRUE(odometry.ok());
  EXPECT_EQ(odometry->covariance.x_m2, 0.0);
  EXPECT_EQ(input.covariance_fault(),
            "pose.covariance[7] is -1; a variance is finite and at least 0");

  message.pose.covariance[7] = 0.09;
  message.pose.covariance[35] = NAN;
  ASSERT_TRUE(input.next(message).ok());
  EXPECT_EQ(input.covariance_fault(),
            "pose.covariance[35] is nan; a variance is finite and at least 0");

  message.pose.covariance[35] = 0.25;
  message.pose.covariance[5] = 5.0;
  odometry = input.next(message);
  ASSERT_TRUE(odometry.ok());
  EXPECT_EQ(odometry->covariance.x_m2, 0.0);
  EXPECT_EQ(input.covariance_fault(),
            "pose.covariance[1], [5] and [11] are 0, 5 and 0; between variances of 0.04, 0.09 and "
            "0.25 each is at most the root of their product");

  message.pose.covariance[5] = 0.1;
  odometry = input.next(message);
  ASSERT_TRUE(odometry.ok());
  EXPECT_EQ(odometry->covariance.x_heading_m_rad, 0.1);
  EXPECT_EQ(input.covariance_fault(), "");
}

}  // namespace
}  // namespace clew::ros2
