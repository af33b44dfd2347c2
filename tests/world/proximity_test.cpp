// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "random_world.hpp"
#include "world/shapes.hpp"
#include "world/world.hpp"

namespace clew::world {
namespace {

using core::radians;

TEST(Clearance, IsTheDistanceToTheNearestSurface) {
  const World world = make_world("walls: [[7, 1, 7, 9]]\ncircles: [[3, 5, 0.5]]");

  EXPECT_DOUBLE_EQ(world.clearance_m({6, 5}, 5.0, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(world.clearance_m({4.5, 5}, 5.0, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(world.clearance_m({5, 9.5}, 5.0, 0.0), 0.5);
  EXPECT_DOUBLE_EQ(world.clearance_m({5, 5}, 0.75, 0.0), 0.75);
}

TEST(Clearance, IsZeroInsideFilledObstacles) {
  const World world =
      make_world("polygons: [[[2, 2], [4, 2], [4, 4], [2, 4]]]\ncircles: [[7, 7, 1]]");

  EXPECT_EQ(world.clearance_m({3, 3}, 5.0, 0.0), 0.0);
  EXPECT_EQ(world.clearance_m({7.1, 7}, 5.0, 0.0), 0.0);
}

TEST(Clearance, TheIndexFindsExactlyWhatLookingAtAllFinds) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const World world = random_world(seed, false);
    const auto segments = all_segments(world);
    Dice dice(6000 + seed);
    for (int query = 0; query < 200; ++query) {
      const Vec2 point = dice.point(0.1, 9.9);
      double expected = 5.0;
      for (const auto& s : segments) {
        expected = std::min(expected, distance(point, nearest_point(s, point)));
      }
      for (const auto& c : world.circles()) {
        expected = std::min(expected, std::max(distance(point, c.centre) - c.radius_m, 0.0));
      }
      const double clearance = world.clearance_m(point, 5.0, 0.0);

      // Inside a polygon its sides are not what counts.
      EXPECT_TRUE(clearance == expected || clearance == 0.0) << clearance << ' ' << expected;
    }
  }
}

TEST(Contacts, AreNoneInTheOpen) {
  const World world = make_world("walls: [[7, 1, 7, 9]]");

  EXPECT_TRUE(world.contacts_rad({5, 5}, 0.15, 0.01, 0.0).empty());
}

TEST(Contacts, PointToEachWallTouchedTheNearestFirst) {
  const World world = make_world("walls: [[7, 1, 7, 9]]\ncircles: [[6.5, 5.65, 0.5]]");

  // The wall is 0.15 m to the right; the circle's centre 0.66 m away, at asin(0.65 / 0.66)... from
  // (6.85, 5): bearing atan2(0.65, -0.35), distance sqrt(0.65^2 + 0.35^2) - 0.5 = 0.238 m.
  const auto both = world.contacts_rad({6.85, 5}, 0.15, 0.1, 0.0);
  const auto one = world.contacts_rad({6.85, 5}, 0.15, 0.01, 0.0);

  ASSERT_EQ(both.size(), 2u);
  EXPECT_DOUBLE_EQ(both[0], 0.0);
  EXPECT_NEAR(both[1], core::atan2(0.65, -0.35), 1e-12);
  ASSERT_EQ(one.size(), 1u);
}

TEST(Contacts, InACornerAreTwo) {
  const World world = make_world("");

  const auto contacts = world.contacts_rad({9.85, 9.84}, 0.15, 0.02, 0.0);

  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_NEAR(contacts[0], 0.0, 1e-12);
  EXPECT_NEAR(contacts[1], radians(90.0), 1e-12);
}

TEST(Contacts, AtAPolygonsVertexIsOne) {
  const World world = make_world("polygons: [[[5, 5], [6, 4], [6, 6]]]");

  const auto contacts = world.contacts_rad({4.85, 5}, 0.15, 0.01, 0.0);

  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_DOUBLE_EQ(contacts[0], 0.0);
}

TEST(Contacts, AreAtMostTheEightNearest) {
  // Twelve posts around the disc, each a little farther than the one before.
  std::string circles = "circles: [";
  for (int i = 0; i < 12; ++i) {
    const Vec2 c = Vec2(5, 5) + (0.25 + 0.001 * i) * core::direction(radians(30.0 * i));
    circles += "[" + std::to_string(c.x()) + ", " + std::to_string(c.y()) + ", 0.05],";
  }
  const World world = make_world(circles + "]");

  const auto contacts = world.contacts_rad({5, 5}, 0.19, 0.05, 0.0);

  ASSERT_EQ(contacts.size(), 8u);
  for (int i = 0; i < 8; ++i) {
    // The file's six decimals move a post by at most 1e-6 m, 4e-6 rad at this distance.
    EXPECT_NEAR(core::wrap_angle_rad(contacts[static_cast<std::size_t>(i)] - radians(30.0 * i)),
                0.0, 1e-5);
  }
}

TEST(Contacts, FollowAMovingObstacle) {
  const World world = make_world("moving: [{circle: [2, 5, 0.5], path: [[0, 2, 5], [6, 8, 5]]}]");

  EXPECT_TRUE(world.contacts_rad({5, 5}, 0.15, 0.01, 0.0).empty());
  const auto contacts = world.contacts_rad({5, 5}, 0.15, 0.01, 2.35);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(contacts[0], radians(180.0), 1e-12);
}

TEST(Contacts, AreWhatASweepStoppedAt) {
  const World world = random_world(3, false);
  Dice dice(7000);
  int touched = 0;
  for (int query = 0; query < 300; ++query) {
    const Vec2 from = dice.point(0.5, 9.5);
    const Vec2 way = dice.point(-1.0, 1.0);
    if (world.clearance_m(from, 1.0, 0.0) < 0.16) continue;
    const Sweep sweep = world.sweep_disc(from, from + way, 0.15, 0.0, 0.3);
    if (!sweep.contact) continue;
    const Vec2 at = from + sweep.free_fraction * way;

    const auto contacts = world.contacts_rad(at, 0.15, 1e-6, 0.0);

    const double bearing = core::bearing_rad({at.x(), at.y(), 0.0}, sweep.contact_point);
    EXPECT_TRUE(std::any_of(contacts.begin(), contacts.end(), [&](double contact) {
      return std::fabs(core::wrap_angle_rad(contact - bearing)) < 1e-6;
    })) << query;
    ++touched;
  }
  EXPECT_GT(touched, 50);
}

}  // namespace
}  // namespace clew::world
