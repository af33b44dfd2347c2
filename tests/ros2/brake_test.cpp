// SPDX-License-Identifier: Apache-2.0
#include "robot/brake.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math.hpp"

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

}  // namespace
}  // namespace clew::robot
