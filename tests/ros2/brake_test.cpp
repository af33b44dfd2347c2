// SPDX-License-Identifier: Apache-2.0
#include "robot/brake.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math.hpp"
#include "robot/robot_link.hpp"
#include "ros2/robot_inputs.hpp"

namespace clew::robot {
namespace {

constexpr double kRadius_m = 0.2;

TEST(Brake, LetsGoWhatDoesNotComeTooNear) {
  // After 1 s at 0.5 m/s the centre is at 0.5, its skin at 0.7.
  EXPECT_FALSE(bearing_of_contact_rad({{0.71, 0.0}}, kRadius_m, {0.5, 0.0}, 1.0));
  EXPECT_FALSE(bearing_of_contact_rad({{0.3, 0.21}}, kRadius_m, {0.5, 0.0}, 1.0));
  EXPECT_FALSE(bearing_of_contact_rad({}, kRadius_m, {0.5, 0.0}, 1.0));
}

TEST(Brake, TellsWhereTheRobotWouldTouch) {
  const auto ahead = bearing_of_contact_rad({{0.69, 0.0}}, kRadius_m, {0.5, 0.0}, 1.0);
  const auto left = bearing_of_contact_rad({{0.3, 0.19}}, kRadius_m, {0.5, 0.0}, 1.0);
  const auto behind = bearing_of_contact_rad({{-0.4, 0.0}}, kRadius_m, {-0.5, 0.0}, 1.0);

  ASSERT_TRUE(ahead && left && behind);
  EXPECT_EQ(*ahead, 0.0);
  EXPECT_NEAR(*left, std::atan2(0.19, 0.3), 1e-12);
  EXPECT_NEAR(std::fabs(*behind), core::kPi, 1e-12);
}

TEST(Brake, FollowsTheArc) {
  // A quarter of a circle of 0.5 m to the left ends at (0.5, 0.5).
  const domain::Velocities left{0.5, 1.0};
  const double quarter_s = core::kPi / 2.0;

  EXPECT_TRUE(bearing_of_contact_rad({{0.5, 0.6}}, kRadius_m, left, quarter_s));
  EXPECT_FALSE(bearing_of_contact_rad({{0.75, 0.0}}, kRadius_m, left, quarter_s));
}

TEST(Brake, LetsARobotThatIsTooNearAlreadyGoAway) {
  const std::vector<core::Vec2> wall = {{0.15, 0.0}};

  EXPECT_FALSE(bearing_of_contact_rad(wall, kRadius_m, {-0.5, 0.0}, 1.0));
  EXPECT_FALSE(bearing_of_contact_rad(wall, kRadius_m, {0.0, 1.0}, 1.0));
  EXPECT_TRUE(bearing_of_contact_rad(wall, kRadius_m, {0.5, 0.0}, 1.0));
}

/// A laser at the robot's centre with four beams: behind, right, ahead, left.
ros2::LaserScan scan_of(float ahead_m, float left_m) {
  ros2::LaserScan scan;
  scan.angle_min = static_cast<float>(-core::kPi);
  scan.angle_increment = static_cast<float>(core::kPi / 2.0);
  scan.angle_max = static_cast<float>(core::kPi / 2.0);
  scan.range_max = 4.0F;
  scan.ranges = {4.5F, 4.5F, ahead_m, left_m};
  return scan;
}

TEST(Brake, TakesAnOldScanWhereItWasMeasured) {
  // Measured 0.3 m further back: the wall that stood 1 m ahead is 0.7 m ahead by now.
  RobotView view;
  view.scan = scan_of(1.0F, 4.5F);
  view.pose_odom_at_scan = core::Pose2{2.0, 1.0, 0.0};
  const core::Pose2 robot{2.3, 1.0, 0.0};

  const auto seen = ros2::returns_of(view.scan, view.laser_seen_from(robot));

  ASSERT_EQ(seen.size(), 1u);
  EXPECT_NEAR(seen[0].x(), 0.7, 1e-6);
  EXPECT_NEAR(seen[0].y(), 0.0, 1e-6);
  // 0.6 m on, with a radius of 0.2 m, it would touch; seen from where the scan was, it would not.
  EXPECT_TRUE(bearing_of_contact_rad(seen, kRadius_m, {0.6, 0.0}, 1.0));
  EXPECT_FALSE(bearing_of_contact_rad(ros2::returns_of(view.scan, {}), kRadius_m, {0.6, 0.0}, 1.0));
}

TEST(Brake, TurnsAnOldScanWithTheRobot) {
  // It has turned by a quarter to the left since: what was on its left is ahead.
  RobotView view;
  view.scan = scan_of(4.5F, 0.5F);
  view.pose_odom_at_scan = core::Pose2{0.0, 0.0, 0.0};

  const auto seen = ros2::returns_of(view.scan, view.laser_seen_from({0.0, 0.0, core::kPi / 2.0}));

  ASSERT_EQ(seen.size(), 1u);
  EXPECT_NEAR(seen[0].x(), 0.5, 1e-6);
  EXPECT_NEAR(seen[0].y(), 0.0, 1e-6);
}

TEST(Brake, TakesAScanBeforeAllOdometryAsIfItWereNew) {
  RobotView view;
  view.scan = scan_of(1.0F, 4.5F);
  view.pose_robot_laser = {0.1, 0.0, 0.0};

  const auto seen = ros2::returns_of(view.scan, view.laser_seen_from({2.3, 1.0, 0.0}));

  ASSERT_EQ(seen.size(), 1u);
  EXPECT_NEAR(seen[0].x(), 1.1, 1e-6);
}

}  // namespace
}  // namespace clew::robot
