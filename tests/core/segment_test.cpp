// SPDX-License-Identifier: Apache-2.0
#include "core/segment.hpp"

#include <gtest/gtest.h>

namespace clew::core {
namespace {

const Vec2 kFrom(1.0, 1.0);
const Vec2 kTo(5.0, 1.0);

TEST(FractionAlong, IsZeroAtTheBeginningOneAtTheEndAndBeyondThemOutside) {
  EXPECT_EQ(fraction_along(kFrom, kTo, {1.0, 3.0}), 0.0);
  EXPECT_EQ(fraction_along(kFrom, kTo, {2.0, -3.0}), 0.25);
  EXPECT_EQ(fraction_along(kFrom, kTo, {5.0, 0.0}), 1.0);
  EXPECT_EQ(fraction_along(kFrom, kTo, {-1.0, 1.0}), -0.5);
  EXPECT_EQ(fraction_along(kFrom, kTo, {7.0, 1.0}), 1.5);
  EXPECT_EQ(fraction_along(kFrom, kFrom, {7.0, 1.0}), 0.0);
}

TEST(DistanceToSegment, IsThatToTheFootOfThePerpendicularOrToAnEnd) {
  EXPECT_EQ(distance_to_segment_m(kFrom, kTo, {2.0, 3.0}), 2.0);
  EXPECT_EQ(distance_to_segment_m(kFrom, kTo, {4.0, 1.0}), 0.0);
  EXPECT_EQ(distance_to_segment_m(kFrom, kTo, {-2.0, 5.0}), 5.0);  // 3, 4, 5 from (1, 1)
  EXPECT_EQ(distance_to_segment_m(kFrom, kTo, {8.0, -3.0}), 5.0);  // from (5, 1)
  EXPECT_EQ(distance_to_segment_m(kFrom, kFrom, {4.0, 5.0}), 5.0);
}

}  // namespace
}  // namespace clew::core
