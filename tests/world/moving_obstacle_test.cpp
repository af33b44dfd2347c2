// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "world/path_walk.hpp"
#include "world/world.hpp"

namespace clew::world {
namespace {

MovingObstacle to_and_fro(bool loop) {
  return {0.3, {{0.0, {1, 1}}, {4.0, {5, 1}}, {6.0, {5, 3}}}, loop};
}

TEST(MovingObstacle, IsLinearBetweenItsPoints) {
  const MovingObstacle obstacle = to_and_fro(false);

  EXPECT_EQ(obstacle.position_at(0.0), Vec2(1, 1));
  EXPECT_EQ(obstacle.position_at(1.0), Vec2(2, 1));
  EXPECT_EQ(obstacle.position_at(4.0), Vec2(5, 1));
  EXPECT_EQ(obstacle.position_at(5.0), Vec2(5, 2));
}

TEST(MovingObstacle, StaysAtItsLastPoint) {
  EXPECT_EQ(to_and_fro(false).position_at(6.0), Vec2(5, 3));
  EXPECT_EQ(to_and_fro(false).position_at(1e6), Vec2(5, 3));
}

TEST(MovingObstacle, WrapsAtItsLastTimeIfItLoops) {
  const MovingObstacle obstacle = to_and_fro(true);

  EXPECT_EQ(obstacle.position_at(6.0), Vec2(1, 1));
  EXPECT_EQ(obstacle.position_at(7.0), Vec2(2, 1));
  EXPECT_EQ(obstacle.position_at(6000.0 + 5.0), Vec2(5, 2));
}

TEST(MovingObstacle, OfOnePointStands) {
  const MovingObstacle obstacle{0.3, {{0.0, {1, 2}}}, true};

  EXPECT_EQ(obstacle.position_at(0.0), Vec2(1, 2));
  EXPECT_EQ(obstacle.position_at(17.0), Vec2(1, 2));
}

TEST(PathWalk, GoesFromLegToLeg) {
  const MovingObstacle obstacle = to_and_fro(true);

  PathWalk walk(obstacle, 5.5);
  const double first_end_s = walk.leg_end_s();
  walk.advance();
  const Vec2 second_begin = walk.position_at(6.0);
  const double second_end_s = walk.leg_end_s();

  EXPECT_EQ(first_end_s, 6.0);
  EXPECT_EQ(second_begin, Vec2(1, 1));
  EXPECT_EQ(second_end_s, 10.0);
}

TEST(PathWalk, EndsInALegWithoutEnd) {
  const MovingObstacle obstacle = to_and_fro(false);

  PathWalk walk(obstacle, 5.5);
  walk.advance();

  EXPECT_EQ(walk.leg_end_s(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(walk.position_at(100.0), Vec2(5, 3));
}

}  // namespace
}  // namespace clew::world
