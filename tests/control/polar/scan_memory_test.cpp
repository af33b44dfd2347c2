// SPDX-License-Identifier: Apache-2.0
#include "control/polar/scan_memory.hpp"

#include <gtest/gtest.h>

#include "core/angle.hpp"

namespace clew::control {
namespace {

using core::radians;

constexpr double kRadius_m = 0.15;

/// Beams to the left, ahead and to the right.
domain::Scan scan_of(double left_m, double ahead_m, double right_m) {
  domain::Scan scan;
  scan.bearing_first_rad = radians(90.0);
  scan.bearing_step_rad = radians(-90.0);
  scan.beam_width_rad = radians(15.0);
  scan.range_max_m = 2.0;
  scan.ranges_m = {left_m, ahead_m, right_m};
  return scan;
}

std::vector<core::Vec2> seen_from(const ScanMemory& memory, const core::Pose2& pose,
                                  double scope_m = 5.0) {
  std::vector<core::Vec2> returns;
  memory.returns_seen_from(pose, scope_m, returns);
  return returns;
}

TEST(ScanMemory, TellsReturnsAsIfMeasuredFromElsewhere) {
  ScanMemory memory(3, 3, kRadius_m);
  memory.add({1.0, 1.0, radians(90.0)}, scan_of(2.0, 0.85, 2.0));  // a return at (1, 2)

  const auto returns = seen_from(memory, {0.0, 2.0, radians(180.0)});

  ASSERT_EQ(returns.size(), 1u);  // what is at the sensor's range is no return
  EXPECT_NEAR(returns[0].x(), -1.0, 1e-12);
  EXPECT_NEAR(returns[0].y(), 0.0, 1e-12);
}

TEST(ScanMemory, KeepsTheLastScansOnly) {
  ScanMemory memory(2, 3, kRadius_m);
  for (const double ahead_m : {0.25, 0.35, 0.45}) memory.add({}, scan_of(2.0, ahead_m, 2.0));

  const auto returns = seen_from(memory, {});

  ASSERT_EQ(returns.size(), 2u);  // the newest first
  EXPECT_NEAR(returns[0].x(), 0.60, 1e-12);
  EXPECT_NEAR(returns[1].x(), 0.50, 1e-12);
}

TEST(ScanMemory, LeavesOutWhatIsInTheBodyOrOutOfScope) {
  ScanMemory memory(2, 3, kRadius_m);
  memory.add({}, scan_of(1.0, 0.10, 0.50));  // at 1.15 m left, 0.25 m ahead, 0.65 m right

  const auto returns = seen_from(memory, {0.12, 0.0, 0.0}, 1.0);

  // Seen from 0.12 m ahead they are 1.16, 0.13 and 0.66 m away.
  ASSERT_EQ(returns.size(), 1u);
  EXPECT_NEAR(returns[0].y(), -0.65, 1e-12);
}

TEST(ScanMemory, TellsTheNewestScanAlone) {
  ScanMemory memory(4, 3, kRadius_m);
  memory.add({}, scan_of(0.5, 0.5, 0.5));
  memory.add({}, scan_of(2.0, 0.25, 2.0));
  std::vector<core::Vec2> returns;

  memory.newest_seen_from({}, 5.0, returns);

  ASSERT_EQ(returns.size(), 1u);
  EXPECT_NEAR(returns[0].x(), 0.4, 1e-12);
}

TEST(ScanMemory, Forgets) {
  ScanMemory memory(2, 3, kRadius_m);
  memory.add({}, scan_of(0.5, 0.5, 0.5));

  memory.forget();

  EXPECT_TRUE(seen_from(memory, {}).empty());
}

}  // namespace
}  // namespace clew::control
