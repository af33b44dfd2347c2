// SPDX-License-Identifier: Apache-2.0
#include "world/moving_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "world/world.hpp"

namespace clew::world {
namespace {

core::Result<World> parse(const std::string& moving) {
  return World::parse(
      "format: clew-world/1\nname: doors\nbounds: [0, 0, 10, 10]\nstart: [1, 1, 0]\n"
      "target: [9, 9]\ntarget_radius: 0.2\nmoving: [" +
          moving + "]\n",
      "doors.yaml");
}

// Hinged at (5, 5), a metre long, closed along the x axis; it opens by a right angle in two
// seconds, and is open up to second 6.
const char* const kDoor =
    "{door: [5, 5, 1], turns: [[0, 0], [1, 0], [3, 1.5707963267948966], [6, 1.5707963267948966]]}";

/// How far a ray from (x, y) upward gets.
double up(const World& world, double x_m, double y_m, double time_s) {
  const Sweep sweep = world.sweep_disc({x_m, y_m}, {x_m, 9.9}, 1e-6, time_s, 0.0);
  return sweep.free_fraction * (9.9 - y_m);
}

TEST(Door, IsInTheWayWhereItsLeafIs) {
  const World world = *parse(kDoor);

  // Closed: along y = 5 from x = 5 to 6, and half a side's thickness more.
  for (double x_m = 5.0; x_m <= 6.0; x_m += 0.0137) {
    EXPECT_NEAR(up(world, x_m, 4.0, 0.5), 1.0 - kSideRadius_m, 0.003) << x_m;
  }
  EXPECT_GT(up(world, 4.9, 4.0, 0.5), 5.0);
  EXPECT_GT(up(world, 6.1, 4.0, 0.5), 5.0);
  // Open: along x = 5.
  EXPECT_GT(up(world, 5.5, 4.0, 5.0), 5.0);
  EXPECT_NEAR(up(world, 5.0, 4.0, 5.0), 1.0 - kSideRadius_m, 0.003);
}

TEST(Door, TurnsAsARodDoes) {
  const World world = *parse(kDoor);

  for (double time_s = 1.0; time_s <= 3.0; time_s += 0.07) {
    const double angle_rad = (time_s - 1.0) / 2.0 * 1.5707963267948966;
    const Vec2 tip = world.moving().back().position_at(time_s);
    EXPECT_NEAR(tip.x(), 5.0 + std::cos(angle_rad), 1e-3) << time_s;
    EXPECT_NEAR(tip.y(), 5.0 + std::sin(angle_rad), 1e-3) << time_s;
    const Vec2 middle = world.moving()[world.moving().size() / 2].position_at(time_s);
    EXPECT_NEAR(core::length(middle - (tip + Vec2(5, 5)) / 2.0), 0.0, 1e-9) << time_s;
  }
}

TEST(Door, PushesNoRobotThroughItsLeaf) {
  const World world = *parse(kDoor);
  // A small disc that stands where the leaf comes by: it is struck.
  const Sweep sweep = world.sweep_disc({5.5, 5.5}, {5.5, 5.5}, 0.05, 0.0, 3.0);
  EXPECT_TRUE(sweep.contact);
  EXPECT_TRUE(sweep.moving_obstacle);
}

TEST(MovingPolygon, IsInTheWayWithAllItsSides) {
  const World world = *parse(
      "{polygon: [[4, 5], [6, 5], [6, 7], [4, 7]], path: [[0, 4, 5], [2, 4, 6]], loop: true}");

  for (double x_m = 4.0; x_m <= 6.0; x_m += 0.0171) {
    EXPECT_NEAR(up(world, x_m, 4.0, 0.0), 1.0 - kSideRadius_m, 0.003) << x_m;
    EXPECT_NEAR(up(world, x_m, 4.0, 1.0), 1.5 - kSideRadius_m, 0.003) << x_m;
  }
  EXPECT_GT(up(world, 6.1, 4.0, 0.0), 5.0);
  // No disc of a robot's size gets in from any side.
  EXPECT_TRUE(world.sweep_disc({3, 6}, {5, 6}, 0.01, 0.0, 0.0).contact);
  EXPECT_TRUE(world.sweep_disc({7, 6}, {5, 6}, 0.01, 0.0, 0.0).contact);
  EXPECT_TRUE(world.sweep_disc({5, 8}, {5, 6}, 0.01, 0.0, 0.0).contact);
}

TEST(Door, LoopsFromItsLastTime) {
  const World world =
      *parse("{door: [5, 5, 1], turns: [[0, 0], [1, 1.5707963267948966], [2, 0]], loop: true}");

  for (double time_s = 0.0; time_s < 2.0; time_s += 0.13) {
    for (const MovingObstacle& disc : world.moving()) {
      EXPECT_NEAR(core::length(disc.position_at(time_s) - disc.position_at(time_s + 6.0)), 0.0,
                  1e-9)
          << time_s;
    }
  }
  EXPECT_GT(up(world, 5.5, 4.0, 1.0), 5.0);
  EXPECT_NEAR(up(world, 5.5, 4.0, 8.0), 1.0 - kSideRadius_m, 0.003);
}

TEST(Door, MayTurnALittleAsFastAsTimesMayRise) {
  // 0.003 - 0.002 is less than 0.001.
  EXPECT_TRUE(parse("{door: [5, 5, 1], turns: [[0, 0], [0.002, 0], [0.003, 0.01]]}").ok());
}

TEST(MovingShape, LetsTwoTogetherHaveWhatOneMayHave) {
  const std::string door = "{door: [5, 5, 39.98], turns: [[0, 0]]}";  // 2000 discs
  EXPECT_EQ(parse(door + ", " + door)->moving().size(), kMostSideDiscs);
  EXPECT_FALSE(parse(door + ", " + door + ", {door: [5, 5, 0.01], turns: [[0, 0]]}").ok());
  // A circle is no shape of many discs.
  EXPECT_TRUE(parse(door + ", " + door + ", {circle: [2, 8, 0.3], path: [[0, 2, 8]]}").ok());
}

TEST(MovingShape, CountsTheDiscsThatItMakes) {
  EXPECT_EQ(parse("{door: [5, 5, 0.05], turns: [[0, 0]]}")->moving().size(), 4U);
  // Sides of 3 cm, 4.2 cm and 3 cm: 2, 3 and 2.
  EXPECT_EQ(parse("{polygon: [[5, 5], [5.03, 5], [5, 5.03]], path: [[0, 5, 5]]}")->moving().size(),
            7U);
}

TEST(MovingShape, StopsARobotBetweenTwo) {
  const World world = *parse(
      "{door: [4, 4, 2], turns: [[0, 0]]}, "
      "{polygon: [[4, 6], [6, 6], [6, 8]], path: [[0, 4, 6]]}");
  EXPECT_TRUE(world.sweep_disc({5, 5}, {5, 3}, 0.1, 0.0, 0.0).contact);
  EXPECT_TRUE(world.sweep_disc({5, 5}, {5, 7}, 0.1, 0.0, 0.0).contact);
  EXPECT_FALSE(world.sweep_disc({5, 5}, {8, 5}, 0.1, 0.0, 0.0).contact);
}

TEST(MovingShape, IsOneEntryOfItsFile) {
  const World world = *parse(std::string("{circle: [2, 8, 0.3], path: [[0, 2, 8]]}, ") + kDoor);

  EXPECT_EQ(world.moving().front().entry, 0U);
  EXPECT_EQ(world.moving()[1].entry, 1U);
  EXPECT_EQ(world.moving().back().entry, 1U);
  const auto in_the_way = parse(std::string(
      "{circle: [2, 8, 0.3], path: [[0, 2, 8]]}, {door: [0.5, 1, 2], turns: [[0, 0]]}"));
  ASSERT_FALSE(in_the_way.ok());
  EXPECT_NE(in_the_way.error().text().find("inside or on an obstacle, moving[1]"),
            std::string::npos)
      << in_the_way.error().text();
}

}  // namespace
}  // namespace clew::world
