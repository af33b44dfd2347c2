// SPDX-License-Identifier: Apache-2.0
#include "core/angle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.hpp"

namespace clew::core {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Angle, StaysAsItIsInsideTheRange) {
  for (const double angle_rad : {-3.14, -1.0, -0.0, 0.0, 1e-300, 0.1, 3.14, kPi}) {
    EXPECT_EQ(wrap_angle_rad(angle_rad), angle_rad);
  }
}

TEST(Angle, MinusPiIsPi) { EXPECT_EQ(wrap_angle_rad(-kPi), kPi); }

TEST(Angle, WrapsOnceAround) {
  // A turn is 2 pi; the sums round in the last place of about 7.
  constexpr double kTolerance = 1e-15;

  EXPECT_NEAR(wrap_angle_rad(0.1 + 2.0 * kPi), 0.1, kTolerance);
  EXPECT_NEAR(wrap_angle_rad(0.1 - 2.0 * kPi), 0.1, kTolerance);
  EXPECT_NEAR(wrap_angle_rad(4.0), 4.0 - 2.0 * kPi, kTolerance);
  EXPECT_NEAR(wrap_angle_rad(-4.0), 2.0 * kPi - 4.0, kTolerance);
  EXPECT_EQ(wrap_angle_rad(2.0 * kPi), 0.0);
  EXPECT_EQ(wrap_angle_rad(3.0 * kPi), kPi);
}

TEST(Angle, IsNeverOutsideTheRange) {
  const Random random({});
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const double angle_rad = (random.uniform(i) - 0.5) * std::exp2(static_cast<double>(i % 40));

    const double wrapped_rad = wrap_angle_rad(angle_rad);

    ASSERT_GT(wrapped_rad, -kPi) << angle_rad;
    ASSERT_LE(wrapped_rad, kPi) << angle_rad;
  }
}

TEST(Angle, IsNeverOutsideTheRangeNextToItsEnds) {
  for (int turn = -4; turn <= 4; ++turn) {
    const double end_rad = (2 * turn + 1) * kPi;
    for (const double angle_rad :
         {end_rad, std::nextafter(end_rad, kInfinity), std::nextafter(end_rad, -kInfinity)}) {
      EXPECT_GT(wrap_angle_rad(angle_rad), -kPi) << turn;
      EXPECT_LE(wrap_angle_rad(angle_rad), kPi) << turn;
    }
  }
}

TEST(Angle, DoesNotHideNan) {
  EXPECT_TRUE(std::isnan(wrap_angle_rad(std::numeric_limits<double>::quiet_NaN())));
}

TEST(Angle, ConvertsDegrees) {
  EXPECT_EQ(radians(180.0), kPi);
  EXPECT_EQ(degrees(kPi), 180.0);
  EXPECT_DOUBLE_EQ(radians(-90.0), -kPi / 2.0);
  EXPECT_DOUBLE_EQ(degrees(radians(15.0)), 15.0);
}

}  // namespace
}  // namespace clew::core
