// SPDX-License-Identifier: Apache-2.0
#include "world_analysis/severity.hpp"

#include <cmath>

#include "small_world.hpp"

namespace clew::world_analysis {
namespace {

// As for traps: the lattice and what just misses the clearance.
constexpr double kTolerance_m = 0.15;
constexpr double kLeastDepth_m = 2.0 * kRadius_m;

Severity severity(const std::string& obstacles, const std::string& start,
                  const std::string& target) {
  const auto world = small_world(obstacles, start, target);
  const ClearanceGrid grid(world, 0.0);
  return severity_of(grid, TrapMap(grid, kRadius_m, kLeastDepth_m), kRadius_m);
}

TEST(Severity, IsNothingInTheOpen) {
  const Severity found = severity("circles: [[5, 5, 1]]", "[5, 1, 0]", "[5, 9]");

  EXPECT_EQ(found.deepest_m, 0.0);
  EXPECT_EQ(found.nested_pockets, 0u);
  EXPECT_EQ(found.backtrack_m, 0.0);
  EXPECT_EQ(found.bug.straight_m, 8.0);
}

TEST(Severity, CountsAPocketInAPocketAndTakesTheDeepest) {
  const Severity found = severity(
      "walls: [[2, 2, 2, 7], [2, 7, 8, 7], [8, 7, 8, 2], [4, 3, 4, 5.5], [4, 5.5, 6, 5.5], "
      "[6, 5.5, 6, 3]]",
      "[5, 1, 0]", "[5, 8.5]");

  EXPECT_EQ(found.nested_pockets, 2u);
  // From under the upper wall to around the end of a leg.
  EXPECT_NEAR(found.deepest_m, std::hypot(3.0, 6.5) + kRadius_m - (1.5 + kRadius_m), kTolerance_m);
}

TEST(Severity, LeavesOutPocketsThatTheRobotDoesNotGetInto) {
  const std::string closed = "[6, 6, 9, 6], [9, 6, 9, 9], [9, 9, 6, 9], [6, 9, 6, 6]";

  EXPECT_EQ(severity("walls: [" + closed + "]", "[3, 2, 0]", "[3, 8]").nested_pockets, 0u);
  EXPECT_EQ(severity("walls: [" + closed + "]", "[7, 7, 0]", "[3, 8]").deepest_m, Trap::kNoWayOut);
}

}  // namespace
}  // namespace clew::world_analysis
