// SPDX-License-Identifier: Apache-2.0
#include "core/membership.hpp"

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

}  // namespace
}  // namespace clew::core
