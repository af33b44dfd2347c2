// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "random_world.hpp"
#include "world/cone.hpp"
#include "world/sweep.hpp"

namespace clew::world {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// How fast it is shows tests/benchmarks; here, that it works.
TEST(LargeWorld, OfAHundredThousandWallsAnswersAsIfAllWereLookedAt) {
  const World world = world_of_walls(100000, 1, 300.0);
  const auto segments = all_segments(world);
  Dice dice(2);

  ASSERT_EQ(world.walls().size(), 100000u);
  for (int query = 0; query < 20; ++query) {
    const Vec2 at = dice.point(1.0, 299.0);
    const auto direction = ConeDirection::of(dice.between(-3.0, 3.0), core::radians(7.5));
    const Cone cone(at, direction);
    const Vec2 to = at + 3.0 * direction.axis;
    const Motion motion{at, to - at};
    double nearest = kInfinity;
    double fraction = 1.0;
    for (const World::Segment& s : segments) {
      nearest = std::min(nearest, cone.squared_distance(s, kInfinity));
      fraction = std::min(fraction, contact_fraction(motion, 0.15, s));
    }

    EXPECT_EQ(world.cone_distance_m(at, direction, 1e3, 0.0), std::sqrt(nearest));
    EXPECT_EQ(world.sweep_disc(at, to, 0.15, 0.0, 0.3).free_fraction, fraction);
  }
}

TEST(LargeWorld, MayBeOnePolygonWithAHundredThousandSides) {
  std::string text = "polygons: [[";
  constexpr int kSides = 100000;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * core::kPi * i / kSides;
    const Vec2 p = Vec2(5, 5) + (i % 2 == 0 ? 3.0 : 3.01) * core::direction(angle);
    text += "[" + std::to_string(p.x()) + ", " + std::to_string(p.y()) + "],\n";
  }

  const World world = make_world(text + "]]");

  EXPECT_EQ(world.clearance_m({5, 6}, 1.0, 0.0), 0.0);
  // Nearest is a point that sticks out; six decimals round it by 1e-6 m at most.
  EXPECT_NEAR(world.clearance_m({5, 9}, 2.0, 0.0), 0.99, 1e-4);
}

}  // namespace
}  // namespace clew::world
