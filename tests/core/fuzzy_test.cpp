// SPDX-License-Identifier: Apache-2.0
#include "core/fuzzy.hpp"

#include <gtest/gtest.h>

namespace clew::core {
namespace {

TEST(FallingMembership, HoldsUpToFullAndNotFromNoneOn) {
  EXPECT_EQ(falling_membership(-1.0, 0.3, 0.7), 1.0);
  EXPECT_EQ(falling_membership(0.3, 0.3, 0.7), 1.0);
  EXPECT_EQ(falling_membership(0.7, 0.3, 0.7), 0.0);
  EXPECT_EQ(falling_membership(2.0, 0.3, 0.7), 0.0);
}

TEST(FallingMembership, IsLinearBetween) {
  EXPECT_NEAR(falling_membership(0.4, 0.3, 0.7), 0.75, 1e-12);
  EXPECT_NEAR(falling_membership(0.6, 0.3, 0.7), 0.25, 1e-12);
}

const FuzzyPartition kThree{{1.0, 2.0, 4.0}};

TEST(FuzzyPartition, IsFullAtAPeakAndGoneAtItsNeighbours) {
  EXPECT_EQ(kThree.degree(1, 2.0), 1.0);
  EXPECT_EQ(kThree.degree(1, 1.0), 0.0);
  EXPECT_EQ(kThree.degree(1, 4.0), 0.0);
  EXPECT_EQ(kThree.degree(1, 3.0), 0.5);
  EXPECT_EQ(kThree.degree(1, 1.25), 0.25);
}

TEST(FuzzyPartition, StaysFullBeyondTheOuterPeaks) {
  EXPECT_EQ(kThree.degree(0, -10.0), 1.0);
  EXPECT_EQ(kThree.degree(2, 10.0), 1.0);
  EXPECT_EQ(kThree.degree(2, -10.0), 0.0);
  EXPECT_EQ(kThree.degree(0, 10.0), 0.0);
}

TEST(FuzzyPartition, DegreesAddUpToOne) {
  for (double x = 0.0; x < 5.0; x += 0.1) {
    EXPECT_NEAR(kThree.degree(0, x) + kThree.degree(1, x) + kThree.degree(2, x), 1.0, 1e-12) << x;
  }
}

TEST(FuzzyPartition, KnowsWhetherItsPeaksRise) {
  EXPECT_TRUE(kThree.rises());
  EXPECT_FALSE((FuzzyPartition{{1.0, 1.0}}).rises());
}

}  // namespace
}  // namespace clew::core
