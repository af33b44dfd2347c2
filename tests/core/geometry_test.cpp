// SPDX-License-Identifier: Apache-2.0
#include "core/geometry.hpp"

#include <gtest/gtest.h>

namespace clew::core {
namespace {

// Sums of a few numbers of about 1 round by a few units in the last place.
constexpr double kTolerance = 1e-15;

TEST(Geometry, DirectionIsAUnitVectorCounterClockwiseFromX) {
  EXPECT_EQ(direction(0.0), Vec2(1.0, 0.0));
  EXPECT_NEAR(direction(kPi / 2.0).x(), 0.0, kTolerance);
  EXPECT_EQ(direction(kPi / 2.0).y(), 1.0);
  EXPECT_NEAR(direction(-kPi / 6.0).x(), 0.5 * std::sqrt(3.0), kTolerance);
  EXPECT_NEAR(direction(-kPi / 6.0).y(), -0.5, kTolerance);
}

TEST(Geometry, LengthIsThatOfPythagoras) {
  EXPECT_EQ(length({3.0, -4.0}), 5.0);
  EXPECT_EQ(length({0.0, 0.0}), 0.0);
}

TEST(Geometry, BearingIsCounterClockwiseFromTheHeading) {
  // At (1, 2), looking along y: what lies toward +x is to the right.
  const Pose2 pose{1.0, 2.0, kPi / 2.0};

  EXPECT_NEAR(bearing_rad(pose, {1.0, 5.0}), 0.0, kTolerance);
  EXPECT_NEAR(bearing_rad(pose, {3.0, 2.0}), -kPi / 2.0, kTolerance);
  EXPECT_NEAR(bearing_rad(pose, {0.0, 2.0}), kPi / 2.0, kTolerance);
}

TEST(Geometry, BearingOfWhatIsBehindIsPi) {
  EXPECT_EQ(bearing_rad({0.0, 0.0, 0.0}, {-1.0, 0.0}), kPi);
  EXPECT_EQ(bearing_rad({0.0, 0.0, kPi}, {1.0, 0.0}), kPi);
}

TEST(Geometry, BearingOfTheOwnPositionIsZero) {
  EXPECT_EQ(bearing_rad({1.0, 2.0, 0.7}, {1.0, 2.0}), 0.0);
}

TEST(Geometry, BearingIsWrapped) {
  // 170 degrees from x, seen from a heading of -170 degrees: 340 to the left, so 20 to the right.
  const Pose2 pose{0.0, 0.0, radians(-170.0)};

  EXPECT_NEAR(bearing_rad(pose, direction(radians(170.0))), radians(-20.0), 2.0 * kTolerance);
}

TEST(Geometry, DistanceIsFromThePosition) {
  EXPECT_EQ(distance_m({1.0, 1.0, 2.0}, {4.0, 5.0}), 5.0);
}

TEST(Geometry, PosesAreEqualInEveryField) {
  const Pose2 pose{1.0, 2.0, 3.0};

  EXPECT_TRUE((pose == Pose2{1.0, 2.0, 3.0}));
  EXPECT_TRUE((pose != Pose2{1.5, 2.0, 3.0}));
  EXPECT_TRUE((pose != Pose2{1.0, 2.5, 3.0}));
  EXPECT_TRUE((pose != Pose2{1.0, 2.0, 2.5}));
}

}  // namespace
}  // namespace clew::core
