// SPDX-License-Identifier: Apache-2.0
#include "domain/moving_object.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clew::domain {
namespace {

constexpr double kRange_m = 4.0;
constexpr double kRobot_m = 0.15;

/// The pattern of what is at (2, -1) and moves steadily.
MovingObject moving(ObjectMotion motion, const core::Vec2& velocity_mps) {
  MovingObject object;
  object.motion = motion;
  const core::Vec2 now(2.0, -1.0);
  object.bearing_rad = std::atan2(now.y(), now.x());
  for (std::size_t i = 0; i < 3; ++i) {
    const double before_s = 0.5 * static_cast<double>(2 - i);
    object.ranges_m[i] = (now - before_s * velocity_mps).norm() - kRobot_m;
  }
  return object;
}

TEST(MovingObjectTest, ThreeRangesAndTheClassGiveTheVelocity) {
  const core::Vec2 left =
      moving(ObjectMotion::kCrossingLeft, {0.1, 0.7}).velocity_robot_mps(kRobot_m);
  EXPECT_NEAR(left.x(), 0.1, 1e-9);
  EXPECT_NEAR(left.y(), 0.7, 1e-9);

  const core::Vec2 right =
      moving(ObjectMotion::kCrossingRight, {-0.3, -0.5}).velocity_robot_mps(kRobot_m);
  EXPECT_NEAR(right.x(), -0.3, 1e-9);
  EXPECT_NEAR(right.y(), -0.5, 1e-9);
}

TEST(MovingObjectTest, WhatApproachesOrRecedesDoesSoStraight) {
  const core::Vec2 sight = core::Vec2(2.0, -1.0).normalized();

  const core::Vec2 velocity =
      moving(ObjectMotion::kApproaching, -0.8 * sight).velocity_robot_mps(kRobot_m);

  EXPECT_NEAR(velocity.x(), -0.8 * sight.x(), 1e-9);
  EXPECT_NEAR(velocity.y(), -0.8 * sight.y(), 1e-9);
  EXPECT_GT(moving(ObjectMotion::kReceding, 0.8 * sight).velocity_robot_mps(kRobot_m).x(), 0.0);
}

TEST(MovingObjectTest, IsCarriedByARecognition) {
  for (std::uint32_t motion = 0; motion < kObjectMotions; ++motion) {
    for (const double bearing_deg : {-179.9, -90.0, -0.2, 0.0, 45.3, 180.0}) {
      MovingObject object;
      object.motion = static_cast<ObjectMotion>(motion);
      object.bearing_rad = core::radians(bearing_deg);
      object.ranges_m = {7.9, 4.0, 0.5};

      const auto again = to_moving_object(to_recognition(object, kRange_m), kRange_m);

      ASSERT_TRUE(again.has_value());
      EXPECT_EQ(again->motion, object.motion);
      EXPECT_LE(std::fabs(core::wrap_angle_rad(again->bearing_rad - object.bearing_rad)),
                core::radians(0.5) + 1e-12);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(again->ranges_m[i], object.ranges_m[i], 1e-12);
      }
    }
  }
}

TEST(MovingObjectTest, ClassesKeepTheirBounds) {
  MovingObject object;
  object.ranges_m = {9.0, 8.0, 0.0};  // a sensor that sees 4 m tells up to 8 m

  const Recognition recognition = to_recognition(object, kRange_m);

  EXPECT_EQ(recognition.prototype_classes, (std::array<double, 3>{8.0, 8.0, 0.0}));
}

TEST(MovingObjectTest, ANeuronBeyondTheLatticeIsNoObject) {
  Recognition recognition;
  recognition.neuron = 5 * 360;

  EXPECT_FALSE(to_moving_object(recognition, kRange_m).has_value());
}

}  // namespace
}  // namespace clew::domain
