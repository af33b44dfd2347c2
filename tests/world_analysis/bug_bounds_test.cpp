// SPDX-License-Identifier: Apache-2.0
#include "world_analysis/bug_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "small_world.hpp"
#include "world_analysis/boundary_curves.hpp"

namespace clew::world_analysis {
namespace {

constexpr double kPi = 3.14159265358979323846;
// The way of the robot's centre along the wall around the world: its four corners are cut by less
// than a cell each.
constexpr double kOuter_m = 4.0 * (10.0 - 2.0 * kRadius_m);
constexpr double kCorners_m = 4.0 * kSpacing_m;
// Around a disc of 1 m. A chord of 5 cm is shorter than its arc by a part in 10^4.
constexpr double kCircle_m = 2.0 * kPi * (1.0 + kRadius_m);
constexpr double kArc_m = 0.005;
// Up a wall that stands on the lower one and is 6 m long, around its end and down.
constexpr double kWithWall_m =
    kOuter_m - 2.0 * kRadius_m + 2.0 * (6.0 - kRadius_m) + kPi * kRadius_m;
constexpr char kWall[] = "walls: [[5, 0, 5, 6]]";
constexpr char kRoom[] = "walls: [[2, 2, 6, 2], [6, 2, 6, 6], [6, 6, 2, 6], [2, 6, 2, 2]]";

std::vector<double> curves_m(const std::string& obstacles, double radius_m = kRadius_m) {
  const auto world = small_world(obstacles, "[4, 4, 0]", "[9, 9]");
  std::vector<double> lengths_m;
  for (const BoundaryCurve& curve : boundary_curves(ClearanceGrid(world, 0.0), radius_m)) {
    lengths_m.push_back(curve.length_m);
  }
  std::sort(lengths_m.begin(), lengths_m.end());
  return lengths_m;
}

BugBounds bounds(const std::string& obstacles, const std::string& start,
                 const std::string& target) {
  const auto world = small_world(obstacles, start, target);
  return bug_bounds(ClearanceGrid(world, 0.0), kRadius_m);
}

TEST(BoundaryCurves, GoAroundEachObstacleAndAlongTheWallAroundAll) {
  const auto found_m = curves_m("circles: [[7, 5, 1], [2, 8, 1]]");

  ASSERT_EQ(found_m.size(), 3u);
  EXPECT_NEAR(found_m[0], kCircle_m, kArc_m);
  EXPECT_NEAR(found_m[1], kCircle_m, kArc_m);
  EXPECT_NEAR(found_m[2], kOuter_m, kCorners_m);
}

TEST(BoundaryCurves, TakeObstaclesTogetherThatTheRobotDoesNotPassBetween) {
  EXPECT_EQ(curves_m("circles: [[7, 5, 1], [7, 7.2, 1]]").size(), 2u);
  EXPECT_EQ(curves_m("circles: [[7, 5, 1], [7, 7.5, 1]]").size(), 3u);
}

TEST(BoundaryCurves, FollowAWallThatStandsOnAnother) {
  const auto found_m = curves_m(kWall);

  ASSERT_EQ(found_m.size(), 1u);
  EXPECT_NEAR(found_m[0], kWithWall_m, 1.5 * kCorners_m);
}

TEST(BoundaryCurves, AreThoseOfTheRoomThatTheRobotIsIn) {
  const auto found_m = curves_m(kRoom);

  ASSERT_EQ(found_m.size(), 1u);
  EXPECT_NEAR(found_m[0], 4.0 * (4.0 - 2.0 * kRadius_m), kCorners_m);
}

TEST(BoundaryCurves, AreNoneForARobotWithoutRoom) {
  EXPECT_TRUE(curves_m("circles: [[7, 5, 1]]", 5.0).empty());
}

TEST(BugBounds, AreTheStraightWayWithoutObstaclesNearby) {
  // The wall around is 2.85 m from the target, the disc 5.1 m; the start is 2 m from it.
  const BugBounds found = bounds("circles: [[2, 2, 0.5]]", "[5, 5, 0]", "[7, 5]");

  EXPECT_EQ(found.near_target, 0u);
  EXPECT_EQ(found.crossings, 0u);
  EXPECT_EQ(found.straight_m, 2.0);
  EXPECT_EQ(found.bug1_m, 2.0);
  EXPECT_EQ(found.bug2_m, 2.0);
}

TEST(BugBounds, CountAnObstacleOnTheWay) {
  const BugBounds found = bounds("circles: [[5, 5, 1]]", "[1, 5, 0]", "[9, 5]");

  // The disc of 8 m around the target reaches the wall around, too.
  EXPECT_EQ(found.near_target, 2u);
  EXPECT_EQ(found.crossings, 2u);
  EXPECT_NEAR(found.bug1_m, 8.0 + 1.5 * (kCircle_m + kOuter_m), 1.5 * (kCorners_m + kArc_m));
  EXPECT_NEAR(found.bug2_m, 8.0 + kCircle_m, kArc_m);
}

TEST(BugBounds, CountAnObstacleAsOftenAsTheLineCrossesIt) {
  // Both legs of a U that is open below.
  const BugBounds found =
      bounds("walls: [[3, 2, 3, 6], [3, 6, 7, 6], [7, 6, 7, 2]]", "[1, 4, 0]", "[9, 4]");

  // Outside three sides, inside three sides, two ends of half a circle and two outer corners of a
  // quarter.
  const double u_m = 12.0 + (12.0 - 4.0 * kRadius_m) + 3.0 * kPi * kRadius_m;
  EXPECT_EQ(found.crossings, 4u);
  EXPECT_NEAR(found.bug2_m, 8.0 + 2.0 * u_m, 2.0 * kCorners_m);
}

TEST(BugBounds, HoldWithoutAWay) {
  const BugBounds found = bounds(kRoom, "[4, 4, 0]", "[8, 4]");

  const double room_m = 4.0 * (4.0 - 2.0 * kRadius_m);
  EXPECT_EQ(found.crossings, 1u);
  EXPECT_NEAR(found.bug1_m, 4.0 + 1.5 * room_m, 1.5 * kCorners_m);
  EXPECT_NEAR(found.bug2_m, 4.0 + 0.5 * room_m, kCorners_m);
}

}  // namespace
}  // namespace clew::world_analysis
