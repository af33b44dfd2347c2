// SPDX-License-Identifier: Apache-2.0
#include "world/polygon.hpp"

#include <gtest/gtest.h>

#include "random_world.hpp"

namespace clew::world {
namespace {

const Polygon kL{{2, 2}, {6, 2}, {6, 4}, {4, 4}, {4, 6}, {2, 6}};

TEST(Polygon, ContainsWhatIsInside) {
  EXPECT_TRUE(contains(kL, {3, 3}));
  EXPECT_TRUE(contains(kL, {5, 3}));
  EXPECT_TRUE(contains(kL, {3, 5}));
  EXPECT_FALSE(contains(kL, {5, 5}));
  EXPECT_FALSE(contains(kL, {1, 3}));
  EXPECT_FALSE(contains(kL, {7, 3}));
}

TEST(Polygon, CountsAVertexBesideThePointOnce) {
  // The rays from these points pass exactly through vertices.
  EXPECT_TRUE(contains(kL, {3, 4}));
  EXPECT_FALSE(contains(kL, {1, 4}));
  EXPECT_FALSE(contains({{2, 1}, {3, 2}, {2, 3}, {1, 2}}, {0, 2}));
  EXPECT_TRUE(contains({{2, 1}, {3, 2}, {2, 3}, {1, 2}}, {2, 2}));
}

TEST(Polygon, FindsWhereItCrossesItself) {
  EXPECT_FALSE(find_crossing(kL).has_value());
  EXPECT_TRUE(find_crossing({{0, 0}, {2, 2}, {2, 0}, {0, 2}}).has_value());
  EXPECT_TRUE(find_crossing({{0, 0}, {2, 0}, {1, 0}}).has_value());
  EXPECT_TRUE(find_crossing({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}).has_value());
}

TEST(FilledAreas, ContainsWhatOneOfItsPolygonsContains) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const World world = random_world(seed, false);
    const FilledAreas areas(world.polygons());
    Dice dice(8000 + seed);
    for (int i = 0; i < 500; ++i) {
      const Vec2 point = dice.point(0.0, 10.0);
      bool expected = false;
      for (const Polygon& polygon : world.polygons()) expected |= contains(polygon, point);

      EXPECT_EQ(areas.contains(point), expected);
    }
  }
}

}  // namespace
}  // namespace clew::world
