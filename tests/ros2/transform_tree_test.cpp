// SPDX-License-Identifier: Apache-2.0
#include "robot/transform_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math.hpp"

namespace clew::robot {
namespace {

struct Frame {
  std::string parent;
  std::string child;
  ros2::Vector3 at;
  ros2::Quaternion rotation{};
};

TransformTree tree_of(const std::vector<Frame>& frames) {
  ros2::TFMessage message;
  for (const Frame& frame : frames) {
    auto& transform = message.transforms.emplace_back();
    transform.header.frame_id = frame.parent;
    transform.child_frame_id = frame.child;
    transform.transform = {frame.at, frame.rotation};
  }
  TransformTree tree;
  tree.add(message);
  return tree;
}

const double kHalf = std::sqrt(0.5);

TEST(TransformTree, FindsTheLaserOnTheRobotThroughOtherFrames) {
  // A mast that is turned to the left, with the laser 0.2 m ahead on it.
  const auto tree = tree_of({{"odom", "base_footprint", {5.0, 6.0, 0.0}},
                             {"base_footprint", "base_link", {0.0, 0.0, 0.1}},
                             {"base_link", "mast", {0.1, 0.0, 0.3}, {0.0, 0.0, kHalf, kHalf}},
                             {"mast", "laser", {0.2, 0.0, 0.0}}});

  const auto mount = tree.mount("base_footprint", "laser");

  ASSERT_TRUE(mount);
  EXPECT_NEAR(mount->pose_robot_laser.x_m, 0.1, 1e-12);
  EXPECT_NEAR(mount->pose_robot_laser.y_m, 0.2, 1e-12);
  EXPECT_NEAR(mount->pose_robot_laser.heading_rad, core::kPi / 2.0, 1e-12);
  EXPECT_FALSE(mount->upside_down);
}

TEST(TransformTree, ALaserAtTheRobotsOwnFrameNeedsNoTransform) {
  const auto mount = tree_of({}).mount("base_link", "/base_link");

  ASSERT_TRUE(mount);
  EXPECT_EQ(mount->pose_robot_laser, core::Pose2{});
}

TEST(TransformTree, KnowsALaserThatHangs) {
  // Turned about its x axis by half a turn.
  const auto mount = tree_of({{"base_link", "laser", {0.0, 0.0, 0.5}, {1.0, 0.0, 0.0, 0.0}}})
                         .mount("base_link", "laser");

  ASSERT_TRUE(mount);
  EXPECT_TRUE(mount->upside_down);
  EXPECT_NEAR(mount->pose_robot_laser.heading_rad, 0.0, 1e-12);
}

TEST(TransformTree, WhatIsNotConnectedOrNotLevelIsNoMount) {
  const auto tree = tree_of({{"base_link", "camera", {}, {0.0, kHalf, 0.0, kHalf}},
                             {"elsewhere", "laser", {}},
                             {"a", "b", {}},
                             {"b", "a", {}},
                             {"base_link", "broken", {NAN, 0.0, 0.0}}});

  EXPECT_FALSE(tree.mount("base_link", "camera"));
  EXPECT_FALSE(tree.mount("base_link", "laser"));
  EXPECT_FALSE(tree.mount("base_link", "a"));
  EXPECT_FALSE(tree.mount("base_link", "broken"));
}

}  // namespace
}  // namespace clew::robot
