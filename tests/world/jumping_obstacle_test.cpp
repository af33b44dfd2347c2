// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "world/world.hpp"

namespace clew::world {
namespace {

core::Result<World> parse(const std::string& more) {
  return World::parse(
      "format: clew-world/1\nname: jumps\nbounds: [0, 0, 10, 10]\nstart: [1, 1, 0]\n"
      "target: [9, 9]\ntarget_radius: 0.2\nmoving: [{circle: [5, 5, 0.5], "
      "path: [[0, 5, 5], [1, 6, 5], [2, 6, 8]], jumps: true" +
          more + "}]\n",
      "jumps.yaml");
}

TEST(JumpingObstacle, StandsUntilAfterTheTimeOfTheNextPoint) {
  const World world = *parse("");
  const MovingObstacle& obstacle = world.moving().front();
  EXPECT_EQ(obstacle.position_at(0.0), Vec2(5, 5));
  EXPECT_EQ(obstacle.position_at(0.7), Vec2(5, 5));
  EXPECT_EQ(obstacle.position_at(1.0), Vec2(5, 5));
  EXPECT_EQ(obstacle.position_at(1.1), Vec2(6, 5));
  EXPECT_EQ(obstacle.position_at(2.0), Vec2(6, 5));
  EXPECT_EQ(obstacle.position_at(50.0), Vec2(6, 8));
}

TEST(JumpingObstacle, StopsADiscWhereItStandsDuringTheWay) {
  const World world = *parse("");
  // From the left, toward both places; at distance 0.5 + 0.3.
  const Sweep first = world.sweep_disc({3, 5}, {5, 5}, 0.3, 0.0, 1.0);
  ASSERT_TRUE(first.contact);
  EXPECT_NEAR(3.0 + 2.0 * first.free_fraction, 4.2, 1e-6);
  const Sweep second = world.sweep_disc({3, 5}, {6, 5}, 0.3, 1.0, 1.0);
  ASSERT_TRUE(second.contact);
  EXPECT_TRUE(second.moving_obstacle);
  EXPECT_NEAR(3.0 + 3.0 * second.free_fraction, 5.2, 1e-6);
  EXPECT_NEAR(second.contact_point.x(), 5.5, 1e-6);
  // It is gone before the disc gets there.
  EXPECT_FALSE(world.sweep_disc({3, 5}, {7, 5}, 0.3, 1.9, 8.0).contact);
  // A jump onto a disc that stands is no motion of the disc's.
  EXPECT_FALSE(world.sweep_disc({6, 5.7}, {6, 5.7}, 0.3, 0.0, 2.0).contact);
}

TEST(JumpingObstacle, MayNotLoop) {
  const auto world = parse(", loop: true");
  ASSERT_FALSE(world.ok());
  EXPECT_NE(world.error().text().find("an obstacle that jumps cannot loop"), std::string::npos);
}

TEST(JumpingObstacle, IsWhereItIsPlaced) {
  World world = *parse("");
  world.place_moving(0, {2, 2});
  EXPECT_EQ(world.moving().front().position_at(0.0), Vec2(2, 2));
}

}  // namespace
}  // namespace clew::world
