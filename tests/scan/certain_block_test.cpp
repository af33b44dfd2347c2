// SPDX-License-Identifier: Apache-2.0
#include "scan/certain_block.hpp"

#include <gtest/gtest.h>

#include "core/angle.hpp"

namespace clew::scan {
namespace {

using core::radians;

constexpr double kRadius_m = 0.15;

/// One beam ahead.
domain::Scan beam(double reading_m, double width_deg) {
  domain::Scan scan;
  scan.beam_width_rad = radians(width_deg);
  scan.bearing_step_rad = radians(1.0);
  scan.range_max_m = 4.0;
  scan.ranges_m = {reading_m};
  return scan;
}

TEST(CertainBlock, AReturnInTheWayBlocksIt) {
  EXPECT_TRUE(is_certainly_blocked(beam(0.5, 0.0), kRadius_m, 0.0, 1.0));
  EXPECT_FALSE(is_certainly_blocked(beam(4.0, 0.0), kRadius_m, 0.0, 5.0));
}

TEST(CertainBlock, WhatLiesBesideTheWayDoesNot) {
  // A return at 0.65 m from the centre is 0.14 m beside a way at asin(0.14 / 0.65) = 12.4 degrees.
  EXPECT_TRUE(is_certainly_blocked(beam(0.5, 0.0), kRadius_m, radians(12.0), 1.0));
  EXPECT_FALSE(is_certainly_blocked(beam(0.5, 0.0), kRadius_m, radians(13.0), 1.0));
}

TEST(CertainBlock, WhatIsBehindTheEndDoesNot) {
  // The body's rim, less a centimetre, is 0.14 m ahead of its centre.
  EXPECT_TRUE(is_certainly_blocked(beam(0.5, 0.0), kRadius_m, 0.0, 0.52));
  EXPECT_FALSE(is_certainly_blocked(beam(0.5, 0.0), kRadius_m, 0.0, 0.50));
}

TEST(CertainBlock, AnArcThatReachesBeyondTheWayIsNotCertain) {
  // Half of 15 degrees at 0.65 m is 0.085 m beside the axis, at 1.65 m it is 0.215 m.
  EXPECT_TRUE(is_certainly_blocked(beam(0.5, 15.0), kRadius_m, 0.0, 2.0));
  EXPECT_FALSE(is_certainly_blocked(beam(1.5, 15.0), kRadius_m, 0.0, 3.0));
}

TEST(CertainBlock, ViewIsAsWideAsBeamsAndTheStepsBetween) {
  EXPECT_TRUE(is_in_view(beam(0.5, 15.0), radians(7.0)));
  EXPECT_FALSE(is_in_view(beam(0.5, 15.0), radians(8.0)));
  EXPECT_TRUE(is_in_view(beam(0.5, 0.0), radians(0.4)));
  EXPECT_FALSE(is_in_view(beam(0.5, 0.0), radians(0.6)));
}

}  // namespace
}  // namespace clew::scan
