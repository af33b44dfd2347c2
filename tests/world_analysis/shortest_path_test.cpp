// SPDX-License-Identifier: Apache-2.0
#include "world_analysis/shortest_path.hpp"

#include "small_world.hpp"

namespace clew::world_analysis {
namespace {

TEST(ShortestPath, IsStraightWhereNothingIsInTheWay) {
  const auto world = small_world("", "[1.03, 1.02, 0]", "[8.01, 6.04]");

  const auto path = shortest_path(ClearanceGrid(world, 0.0), kRadius_m);

  // sqrt(6.98^2 + 5.02^2)
  ASSERT_TRUE(path.has_value());
  EXPECT_NEAR(path->length_m, 8.5978, 1e-3);
}

TEST(ShortestPath, GoesAroundTheEndOfAWall) {
  const auto world = small_world("walls: [[5, 0, 5, 6]]", "[3, 3, 0]", "[7, 3]");

  const auto path = shortest_path(ClearanceGrid(world, 0.0), kRadius_m);

  // Two tangents to the circle of 0.15 m around (5, 6), sqrt(13 - 0.15^2) each, and the arc between
  // them, 0.15 m times 2 pi - 2 atan(2 / 3) - 2 acos(0.15 / sqrt(13)).
  const double exact_m = 7.2049 + 0.15 * 2.0488;
  ASSERT_TRUE(path.has_value());
  EXPECT_GE(path->length_m, exact_m - 1e-3);
  EXPECT_LE(path->length_m, 1.005 * exact_m);
}

TEST(ShortestPath, IsAWayThatTheRobotCanGo) {
  const auto world = small_world("walls: [[5, 0, 5, 6], [7, 10, 7, 3]]\ncircles: [[3, 7, 1]]",
                                 "[3, 3, 0]", "[9, 9]");
  const ClearanceGrid grid(world, 0.0);

  const auto path = shortest_path(grid, kRadius_m);

  ASSERT_TRUE(path.has_value());
  EXPECT_EQ(path->points.front(), world.start().position());
  EXPECT_EQ(path->points.back(), world.target());
  for (std::size_t i = 1; i < path->points.size(); ++i) {
    EXPECT_FALSE(
        world.sweep_disc(path->points[i - 1], path->points[i], kRadius_m, 0.0, 0.0).contact)
        << i;
  }
}

TEST(ShortestPath, IsNoneWithoutAWay) {
  const auto world = small_world("walls: [[0, 5, 10, 5]]", "[3, 3, 0]", "[7, 7]");

  EXPECT_FALSE(shortest_path(ClearanceGrid(world, 0.0), kRadius_m).has_value());
}

}  // namespace
}  // namespace clew::world_analysis
