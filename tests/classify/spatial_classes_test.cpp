// SPDX-License-Identifier: Apache-2.0
#include "classify/spatial_classes.hpp"

#include <gtest/gtest.h>

namespace clew::classify {
namespace {

constexpr double kVeryNear = 0.95;
constexpr double kNear = 0.5;
constexpr double kFar = 0.1;

struct Row {
  double right;
  double centre;
  double left;
  std::uint8_t spatial_class;
};

// Table I, as printed: right, centre, left, class.
constexpr Row kTableOne[] = {{kVeryNear, kVeryNear, kVeryNear, 0},
                             {kNear, kNear, kNear, 1},
                             {kNear, kNear, kFar, 2},
                             {kNear, kFar, kNear, 3},
                             {kNear, kFar, kFar, 4},
                             {kFar, kNear, kNear, 5},
                             {kFar, kNear, kFar, 6},
                             {kFar, kFar, kNear, 7},
                             {kFar, kFar, kFar, 8}};

TEST(SpatialClasses, AreThoseOfTableOne) {
  for (const Row& row : kTableOne) {
    EXPECT_EQ(spatial_class({row.left, row.centre, row.right}, {}), row.spatial_class);
  }
}

TEST(SpatialClasses, TakeVeryNearAsNearInEveryOtherRow) {
  EXPECT_EQ(spatial_class({kVeryNear, kVeryNear, kNear}, {}), 1);
  EXPECT_EQ(spatial_class({kVeryNear, kFar, kFar}, {}), 7);
}

TEST(SpatialClasses, AreNearFromTheirDegreeOnAndVeryNearAboveIt) {
  EXPECT_EQ(spatial_class({0.3, 0.0, 0.0}, {}), 7);
  EXPECT_EQ(spatial_class({0.29, 0.0, 0.0}, {}), 8);
  EXPECT_EQ(spatial_class({0.9, 0.9, 0.9}, {}), 1);
  EXPECT_EQ(spatial_class({0.91, 0.91, 0.91}, {}), 0);
}

TEST(Nearness, IsThatOfTheLeastReadingOfEachSide) {
  domain::Scan scan;
  scan.range_max_m = 2.0;
  scan.ranges_m = {1.4, 1.0, 1.2, 0.8, 0.4, 2.0, 2.0};

  const Nearness near = nearness(scan, {});

  // Shares 0.5, 0.4 and 0.2: 1.75 - 2.5 u, and 1 up to 0.3.
  EXPECT_NEAR(near.left, 0.5, 1e-12);
  EXPECT_NEAR(near.centre, 0.75, 1e-12);
  EXPECT_EQ(near.right, 1.0);
}

}  // namespace
}  // namespace clew::classify
