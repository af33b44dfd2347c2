// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "random_world.hpp"
#include "world/world.hpp"

namespace clew::world {
namespace {

using core::radians;

// Toward a point from another, in a cone of 15 degrees and a range of 3 m.
std::optional<double> look(const World& world, const Vec2& from, const Vec2& to) {
  const double bearing = core::bearing_rad({from.x(), from.y(), 0.0}, to);
  return world.corner_distance_m(from, bearing, radians(7.5), 3.0);
}

TEST(Corner, IsSeenFromItsInside) {
  const World world = make_world("walls: [[5, 5, 7, 5], [5, 5, 5, 7]]");

  const auto distance = look(world, {6, 6}, {5, 5});

  ASSERT_TRUE(distance.has_value());
  EXPECT_DOUBLE_EQ(*distance, core::hypot(1.0, 1.0));
}

TEST(Corner, IsNotSeenFromItsOutside) {
  const World world = make_world("walls: [[5, 5, 7, 5], [5, 5, 5, 7]]");

  EXPECT_FALSE(look(world, {4, 4}, {5, 5}).has_value());
  EXPECT_FALSE(look(world, {6, 4}, {5, 5}).has_value());
}

TEST(Corner, IsNotSeenBesideTheConeOrBeyondTheRange) {
  const World world = make_world("walls: [[5, 5, 7, 5], [5, 5, 5, 7]]");

  EXPECT_FALSE(look(world, {6, 6}, {5.5, 5}).has_value());
  EXPECT_FALSE(world.corner_distance_m({6, 6}, radians(-135.0), radians(7.5), 1.4).has_value());
  EXPECT_TRUE(world.corner_distance_m({6, 6}, radians(-135.0), radians(7.5), 1.5).has_value());
}

TEST(Corner, IsWhereAWallEndsOnAnother) {
  const World world = make_world("walls: [[3, 5, 7, 5], [5, 5.0004, 5, 7]]");

  EXPECT_TRUE(look(world, {4, 6}, {5, 5}).has_value());
  EXPECT_TRUE(look(world, {6, 6}, {5, 5}).has_value());
  EXPECT_FALSE(look(world, {5, 4}, {5, 5}).has_value());
}

TEST(Corner, IsNotWhereAWallGoesOnStraight) {
  const World world = make_world("walls: [[3, 5, 5, 5], [5, 5, 7, 5]]");

  EXPECT_FALSE(look(world, {5, 6}, {5, 5}).has_value());
}

TEST(Corner, IsInTheBoundary) {
  const World world = make_world("");

  EXPECT_TRUE(look(world, {9, 9}, {10, 10}).has_value());
}

TEST(Corner, OfAPolygonIsOnlyWhereItIsHollow) {
  // An L: its inner corner at (4, 4) is hollow, all others stick out.
  const World world = make_world("polygons: [[[2, 2], [6, 2], [6, 4], [4, 4], [4, 6], [2, 6]]]");

  EXPECT_TRUE(look(world, {5, 5}, {4, 4}).has_value());
  // From beyond (2, 2), through the polygon, its corner at (6, 2) would face this way.
  EXPECT_FALSE(look(world, {3.5, 4.5}, {6, 2}).has_value());
  EXPECT_FALSE(look(world, {1, 1}, {2, 2}).has_value());
}

TEST(Corner, OfTheNearestIsGiven) {
  const World world =
      make_world("walls: [[5, 5, 7, 5], [5, 5, 5, 7], [5.5, 5.5, 6, 5.5], [5.5, 5.5, 5.5, 6]]");

  const auto distance = look(world, {6, 6}, {5, 5});

  ASSERT_TRUE(distance.has_value());
  EXPECT_DOUBLE_EQ(*distance, core::hypot(0.5, 0.5));
}

}  // namespace
}  // namespace clew::world
