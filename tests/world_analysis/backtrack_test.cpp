// SPDX-License-Identifier: Apache-2.0
#include "world_analysis/backtrack.hpp"

#include <cmath>

#include "small_world.hpp"
#include "world_analysis/trap_map.hpp"

namespace clew::world_analysis {
namespace {

constexpr char kU[] = "walls: [[3, 3, 3, 6], [3, 6, 7, 6], [7, 6, 7, 3]]";
// As for traps: the lattice and what just misses the clearance.
constexpr double kTolerance_m = 0.15;

std::optional<double> backtrack_m(const std::string& obstacles, const std::string& start,
                                  const std::string& target) {
  const auto world = small_world(obstacles, start, target);
  return necessary_backtrack_m(ClearanceGrid(world, 0.0), kRadius_m);
}

TEST(NecessaryBacktrack, IsNoneInTheOpen) {
  EXPECT_EQ(backtrack_m("circles: [[5, 5, 1.5]]", "[5, 1, 1.57]", "[5, 9]"), 0.0);
}

TEST(NecessaryBacktrack, IsNoneWhereAMapLeadsAroundTheTrap) {
  // From in front of the U a way beside it only comes nearer.
  EXPECT_EQ(backtrack_m(kU, "[5, 1, 1.57]", "[5, 8]"), 0.0);
}

TEST(NecessaryBacktrack, IsTheTrapsDepthFromItsBottom) {
  const auto world = small_world(kU, "[5, 5.8, 1.57]", "[5, 8]");
  const ClearanceGrid grid(world, 0.0);
  const TrapMap traps(grid, kRadius_m, 0.3);

  const auto backtrack_m = necessary_backtrack_m(grid, kRadius_m);

  ASSERT_EQ(traps.traps().size(), 1u);
  ASSERT_TRUE(backtrack_m.has_value());
  // The start is 0.05 m before the bottom at most.
  EXPECT_NEAR(*backtrack_m, traps.traps()[0].depth_m, kTolerance_m);
}

TEST(NecessaryBacktrack, CountsFromWhereTheRobotStartsInTheTrap) {
  // 4 m from the target; the way out passes a wall's end at sqrt(2^2 + 5^2) m, 0.15 m beside.
  const auto found = backtrack_m(kU, "[5, 4, 1.57]", "[5, 8]");

  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(*found, std::sqrt(29.0) + 0.15 - 4.0, kTolerance_m);
}

TEST(NecessaryBacktrack, IsTheRiseFromOneGapToTheNext) {
  // Two walls from opposite sides: past the first on the right, then past the second on the left.
  const auto found = backtrack_m("walls: [[0, 3, 8, 3], [2, 6, 10, 6]]", "[1, 1, 1.57]", "[9, 9]");

  ASSERT_TRUE(found.has_value());
  // Through the first gap at (8, 3), sqrt(1 + 36) m away, the way only comes nearer; then it leads
  // to the second at (2, 6), sqrt(49 + 9) m away. The robot passes both ends 0.15 m beside.
  EXPECT_NEAR(*found, std::sqrt(58.0) + 0.15 - std::sqrt(37.0), 2.0 * kTolerance_m);
}

TEST(NecessaryBacktrack, HasNoValueWithoutAWay) {
  EXPECT_EQ(backtrack_m("walls: [[0, 5, 10, 5]]", "[3, 3, 0]", "[7, 7]"), std::nullopt);
}

}  // namespace
}  // namespace clew::world_analysis
