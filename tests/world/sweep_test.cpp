// SPDX-License-Identifier: Apache-2.0
#include "world/sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "random_world.hpp"
#include "world/world.hpp"

namespace clew::world {
namespace {

// The disc stops kSweepMargin_m before an obstacle.
constexpr double kTolerance = 2.0 * kSweepMargin_m;

TEST(Sweep, IsFreeWhereNothingIsInTheWay) {
  const World world = make_world("walls: [[7, 1, 7, 9]]");

  const Sweep sweep = world.sweep_disc({5, 5}, {6.8, 5}, 0.15, 0.0, 0.3);

  EXPECT_FALSE(sweep.contact);
  EXPECT_EQ(sweep.free_fraction, 1.0);
}

TEST(Sweep, StopsAtAWall) {
  const World world = make_world("walls: [[7, 1, 7, 9]]");

  const Sweep sweep = world.sweep_disc({5, 5}, {9, 5}, 0.15, 0.0, 0.3);

  // 1.85 m of 4 m are free.
  EXPECT_TRUE(sweep.contact);
  EXPECT_NEAR(sweep.free_fraction, 1.85 / 4.0, kTolerance);
  EXPECT_NEAR(core::length(sweep.contact_point - Vec2(7, 5)), 0.0, kTolerance);
  EXPECT_FALSE(sweep.moving_obstacle);
}

TEST(Sweep, StopsAtTheEndOfAWall) {
  const World world = make_world("walls: [[7, 5.09, 7, 9]]");

  const Sweep sweep = world.sweep_disc({5, 5}, {9, 5}, 0.15, 0.0, 0.3);

  // The end is 0.09 m beside the way; the disc of 0.15 m touches it 0.12 m before.
  EXPECT_TRUE(sweep.contact);
  EXPECT_NEAR(sweep.free_fraction, 1.88 / 4.0, kTolerance);
  EXPECT_NEAR(core::length(sweep.contact_point - Vec2(7, 5.09)), 0.0, kTolerance);
}

TEST(Sweep, StopsAtAWallThatIsASinglePoint) {
  const World world = make_world("walls: [[7, 5, 7, 5]]");

  EXPECT_NEAR(world.sweep_disc({5, 5}, {9, 5}, 0.15, 0.0, 0.3).free_fraction, 1.85 / 4.0,
              kTolerance);
}

TEST(Sweep, PassesTheEndOfAWall) {
  const World world = make_world("walls: [[7, 5.1501, 7, 9]]");

  EXPECT_FALSE(world.sweep_disc({5, 5}, {9, 5}, 0.15, 0.0, 0.3).contact);
}

TEST(Sweep, StopsAtACircle) {
  const World world = make_world("circles: [[7, 5.39, 0.5]]");

  const Sweep sweep = world.sweep_disc({5, 5}, {9, 5}, 0.15, 0.0, 0.3);

  // Centres touch at 0.65 m: sqrt(0.65^2 - 0.39^2) = 0.52 m before the circle.
  EXPECT_TRUE(sweep.contact);
  EXPECT_NEAR(sweep.free_fraction, 1.48 / 4.0, kTolerance);
  const Vec2 at{6.48, 5.0};
  const Vec2 expected = at + (Vec2(7, 5.39) - at) * (0.15 / 0.65);
  EXPECT_NEAR(core::length(sweep.contact_point - expected), 0.0, kTolerance);
}

TEST(Sweep, StopsAtAPolygonAndAtTheBoundary) {
  const World world = make_world("polygons: [[[7, 4], [8, 5], [7, 6]]]");

  EXPECT_NEAR(world.sweep_disc({5, 5}, {9, 5}, 0.15, 0.0, 0.3).free_fraction, 1.85 / 4.0,
              kTolerance);
  EXPECT_NEAR(world.sweep_disc({5, 5}, {5, 15}, 0.15, 0.0, 0.3).free_fraction, 4.85 / 10.0,
              kTolerance);
}

TEST(Sweep, NeverJumpsOverAThinWall) {
  const World world = make_world("walls: [[5, 0, 5, 10]]");

  const Sweep sweep = world.sweep_disc({1, 5}, {9, 5}, 0.001, 0.0, 0.001);

  EXPECT_TRUE(sweep.contact);
  EXPECT_NEAR(sweep.free_fraction, 3.999 / 8.0, kTolerance);
}

TEST(Sweep, TouchingAndMovingAwayOrAlongIsNoContact) {
  const World world = make_world("walls: [[7, 1, 7, 9]]\ncircles: [[2, 5, 0.5]]");
  const Vec2 at_wall{6.85, 5.0};
  const Vec2 at_circle{2.65, 5.0};

  EXPECT_FALSE(world.sweep_disc(at_wall, {6.0, 5.0}, 0.15, 0.0, 0.3).contact);
  EXPECT_FALSE(world.sweep_disc(at_wall, {6.85, 8.0}, 0.15, 0.0, 0.3).contact);
  EXPECT_FALSE(world.sweep_disc(at_wall, {6.85, 1.0}, 0.15, 0.0, 0.3).contact);
  EXPECT_FALSE(world.sweep_disc(at_circle, {3.0, 5.0}, 0.15, 0.0, 0.3).contact);
  EXPECT_FALSE(world.sweep_disc(at_circle, {2.65, 6.0}, 0.15, 0.0, 0.3).contact);
}

TEST(Sweep, TouchingAndMovingInGivesNothing) {
  const World world = make_world("walls: [[7, 1, 7, 9]]");

  const Sweep into = world.sweep_disc({6.85, 5.0}, {6.95, 5.0}, 0.15, 0.0, 0.3);
  const Sweep aslant = world.sweep_disc({6.85, 5.0}, {6.86, 6.0}, 0.15, 0.0, 0.3);

  EXPECT_TRUE(into.contact);
  EXPECT_EQ(into.free_fraction, 0.0);
  EXPECT_TRUE(aslant.contact);
  EXPECT_EQ(aslant.free_fraction, 0.0);
}

TEST(Sweep, OverlappingADiscMayOnlyLeave) {
  const World world = make_world("walls: [[7, 1, 7, 9]]");

  EXPECT_EQ(world.sweep_disc({6.9, 5.0}, {6.95, 5.0}, 0.15, 0.0, 0.3).free_fraction, 0.0);
  EXPECT_EQ(world.sweep_disc({6.9, 5.0}, {6.5, 5.0}, 0.15, 0.0, 0.3).free_fraction, 1.0);
}

TEST(Sweep, AfterAStopTheDiscSlidesAlongTheWall) {
  // A wall in a direction that no double holds exactly.
  const World world = make_world("walls: [[1, 2, 9, 7.3]]");
  const Vec2 along = Vec2(8.0, 5.3) / core::hypot(8.0, 5.3);
  Vec2 at{4.0, 2.5};
  const Vec2 push{-0.3, 0.7};
  at += world.sweep_disc(at, at + push, 0.15, 0.0, 0.3).free_fraction * push;

  for (int i = 0; i < 20; ++i) {
    const Sweep sweep = world.sweep_disc(at, at + 0.1 * along, 0.15, 0.0, 0.3);
    ASSERT_FALSE(sweep.contact) << i;
    at += 0.1 * along;
  }

  EXPECT_GE(world.clearance_m(at, 1.0, 0.0), 0.15);
}

TEST(Sweep, StandingStillTouchesNothingThatStands) {
  const World world = make_world("walls: [[7, 1, 7, 9]]");

  EXPECT_FALSE(world.sweep_disc({6.85, 5.0}, {6.85, 5.0}, 0.15, 0.0, 0.3).contact);
}

TEST(Sweep, AMovingObstacleRunsIntoADiscThatStands) {
  // From x = 2 to 8 in 6 s; radii sum to 0.65, so it touches the disc at x = 5 when it is at 4.35,
  // after 2.35 s.
  const World world = make_world("moving: [{circle: [2, 5, 0.5], path: [[0, 2, 5], [6, 8, 5]]}]");

  const Sweep sweep = world.sweep_disc({5, 5}, {5, 5}, 0.15, 0.0, 5.0);

  EXPECT_TRUE(sweep.contact);
  EXPECT_TRUE(sweep.moving_obstacle);
  EXPECT_NEAR(sweep.free_fraction, 2.35 / 5.0, kTolerance);
  EXPECT_NEAR(core::length(sweep.contact_point - Vec2(4.85, 5.0)), 0.0, kTolerance);
}

TEST(Sweep, ADiscFollowsAMovingObstacleWithoutTouching) {
  const World world = make_world("moving: [{circle: [2, 5, 0.5], path: [[0, 2, 5], [6, 8, 5]]}]");

  // Both move at 1 m/s, 0.7 m apart.
  EXPECT_FALSE(world.sweep_disc({1.3, 5}, {6.3, 5}, 0.15, 0.0, 5.0).contact);
}

TEST(Sweep, SeesAnObstacleThatTurnsWithinTheTick) {
  // It comes down to y = 5 at 1 s and goes up again; a disc below at distance 0.6 < 0.65 is hit at
  // the time when 5 + (1 - t) 3 = 5 - 0.6 + 0.65, t = 1 - 0.05 / 3.
  const World world = make_world(
      "moving: [{circle: [5, 8, 0.5], path: [[0, 5, 8], [1, 5, 5], [2, 5, 8]], loop: true}]");

  const Sweep sweep = world.sweep_disc({5, 4.4}, {5, 4.4}, 0.15, 0.5, 1.0);

  EXPECT_TRUE(sweep.contact);
  EXPECT_NEAR(sweep.free_fraction, 0.5 - 0.05 / 3.0, kTolerance);
}

TEST(Sweep, SeesAnObstacleInALaterRoundOfItsLoop) {
  const World world = make_world(
      "moving: [{circle: [5, 8, 0.5], path: [[0, 5, 8], [1, 5, 5], [2, 5, 8]], loop: true}]");

  const Sweep sweep = world.sweep_disc({5, 4.4}, {5, 4.4}, 0.15, 101.9, 2.0);

  // The round that began at 102 s comes nearest at 103 s.
  EXPECT_TRUE(sweep.contact);
  EXPECT_NEAR(sweep.free_fraction, (1.1 - 0.05 / 3.0) / 2.0, 1e-8);
}

TEST(Sweep, TakesNoTimeWhenTheDurationIsZero) {
  const World world = make_world("moving: [{circle: [2, 5, 0.5], path: [[0, 2, 5], [6, 8, 5]]}]");

  // At 1 s the obstacle is at x = 3; the way from 1 to 5 meets it at 3 - 0.65.
  const Sweep sweep = world.sweep_disc({1, 5}, {5, 5}, 0.15, 1.0, 0.0);

  EXPECT_NEAR(sweep.free_fraction, 1.35 / 4.0, kTolerance);
}

// Along the free part the disc keeps its distance, at its end it touches, and where no contact is
// reported there is none: against steps of a thousandth of the way.
TEST(Sweep, AgreesWithSmallStepsInRandomWorlds) {
  constexpr int kSteps = 1000;
  int contacts = 0;
  int free = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const World world = random_world(seed, true);
    Dice dice(3000 + seed);
    for (int query = 0; query < 40; ++query) {
      const double radius = dice.between(0.05, 0.4);
      const double time_s = dice.between(0.0, 40.0);
      const double duration_s = dice.between(0.0, 3.0);
      const Vec2 from = dice.point(0.5, 9.5);
      const Vec2 way{dice.between(-2.0, 2.0), dice.between(-2.0, 2.0)};
      if (world.clearance_m(from, 1.0, time_s) < radius + 1e-6) continue;

      const Sweep sweep = world.sweep_disc(from, from + way, radius, time_s, duration_s);

      const auto gap = [&](double fraction) {
        return world.clearance_m(from + fraction * way, 1.0, time_s + fraction * duration_s) -
               radius;
      };
      for (int i = 0; i <= kSteps; ++i) {
        ASSERT_GT(gap(sweep.free_fraction * i / kSteps), 0.0) << seed << ' ' << query << ' ' << i;
      }
      if (sweep.contact) {
        EXPECT_LT(gap(sweep.free_fraction), kTolerance);
        ++contacts;
      } else {
        EXPECT_EQ(sweep.free_fraction, 1.0);
        ++free;
      }
    }
  }
  EXPECT_GT(contacts, 200);
  EXPECT_GT(free, 100);
}

TEST(Sweep, ADiscThatBumpsAboutForeverNeverOverlaps) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const World world = random_world(seed, false);
    Dice dice(4000 + seed);
    Vec2 at{0.5, 0.5};
    ASSERT_GE(world.clearance_m(at, 1.0, 0.0), 0.15);
    for (int i = 0; i < 5000; ++i) {
      const Vec2 way = dice.between(0.0, 0.8) * core::direction(dice.between(-3.2, 3.2));
      at += world.sweep_disc(at, at + way, 0.15, 0.0, 0.3).free_fraction * way;
      ASSERT_GE(world.clearance_m(at, 1.0, 0.0), 0.15) << seed << ' ' << i;
    }
  }
}

TEST(Sweep, TheIndexFindsExactlyWhatLookingAtAllFinds) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const World world = random_world(seed, false);
    const auto segments = all_segments(world);
    Dice dice(5000 + seed);
    for (int query = 0; query < 200; ++query) {
      const double radius = dice.between(0.01, 0.4);
      const Vec2 from = dice.point(0.5, 9.5);
      const Vec2 to = dice.point(0.5, 9.5);
      double expected = 1.0;
      for (const World::Segment& s : segments) {
        expected = std::min(expected, contact_fraction({from, to - from}, radius, s));
      }
      for (const World::Circle& c : world.circles()) {
        expected = std::min(expected, contact_fraction({from, to - from}, radius + c.radius_m,
                                                       {c.centre, c.centre}));
      }

      EXPECT_EQ(world.sweep_disc(from, to, radius, 0.0, 0.3).free_fraction, expected);
    }
  }
}

}  // namespace
}  // namespace clew::world
