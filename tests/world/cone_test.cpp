// SPDX-License-Identifier: Apache-2.0
#include "world/cone.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "random_world.hpp"
#include "world/world.hpp"

namespace clew::world {
namespace {

using core::radians;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Coordinates are up to 10 m, whose last bit is 2e-15 m; a few operations follow.
constexpr double kRounding = 1e-12;

TEST(Cone, MeasuresAWallAheadPerpendicularly) {
  const World world = make_world("walls: [[7, 1, 7, 9]]");

  EXPECT_NEAR(world.cone_distance_m({5, 5}, 0.0, radians(7.5), 4.0, 0.0), 2.0, kRounding);
}

TEST(Cone, MeasuresTheNearestPointOfTheClippedWall) {
  // The foot of the perpendicular lies at 90 degrees, outside the cone of 45 +- 15: the nearest
  // point inside is where its upper edge, at 60 degrees, meets the wall 1 m above.
  const World world = make_world("walls: [[1, 6, 9, 6]]");

  EXPECT_NEAR(world.cone_distance_m({5, 5}, radians(45.0), radians(15.0), 4.0, 0.0),
              1.0 / core::sin(radians(60.0)), kRounding);
}

TEST(Cone, SeesAPostNarrowerThanAnyFanOfRays) {
  const World world = make_world("walls: [[6, 5.0001, 6, 5.0002]]");

  EXPECT_NEAR(world.cone_distance_m({5, 5}, 0.0, radians(7.5), 3.0, 0.0), core::hypot(1.0, 1e-4),
              kRounding);
}

TEST(Cone, SeesAWallThatIsASinglePoint) {
  const World world = make_world("walls: [[6, 5, 6, 5]]");

  EXPECT_NEAR(world.cone_distance_m({5, 5}, 0.0, radians(7.5), 3.0, 0.0), 1.0, kRounding);
}

TEST(Cone, MeasuresACircleAlongItsEdgeWhenTheCentreIsBeside) {
  // Centre at 90 degrees, 2 m away, radius 1.2. Along the edge at 60 degrees, t solves
  // t^2 - 2 t 2 cos 30 + 4 - 1.44 = 0.
  const World world = make_world("circles: [[5, 7, 1.2]]");
  const double b = 2.0 * core::cos(radians(30.0));
  const double expected = b - std::sqrt(b * b - 2.56);

  EXPECT_NEAR(world.cone_distance_m({5, 5}, radians(30.0), radians(30.0), 4.0, 0.0), expected,
              kRounding);
}

TEST(Cone, MissesACircleThatOnlyItsBoxReaches) {
  // The circle's nearest direction ends at asin(0.5 / 2) = 14.5 degrees from its centre at 45.
  const World world = make_world("circles: [[6.414213562373095, 6.414213562373095, 0.5]]");

  EXPECT_EQ(world.cone_distance_m({5, 5}, radians(20.0), radians(10.0), 3.0, 0.0), 3.0);
  EXPECT_LT(world.cone_distance_m({5, 5}, radians(21.0), radians(10.0), 3.0, 0.0), 3.0);
}

TEST(Cone, SeesNothingBehind) {
  const World world = make_world("walls: [[4, 1, 4, 9]]\ncircles: [[3, 5, 0.5]]");

  EXPECT_EQ(world.cone_distance_m({5, 5}, 0.0, radians(80.0), 3.0, 0.0), 3.0);
  EXPECT_EQ(world.cone_distance_m({5, 5}, 0.0, 0.0, 3.0, 0.0), 3.0);
}

TEST(Cone, IsZeroInsideFilledObstacles) {
  const World world = make_world(
      "polygons: [[[2, 2], [4, 2], [4, 4], [2, 4]]]\ncircles: [[7, 7, 1]]\n"
      "moving: [{circle: [7, 2, 0.5], path: [[0, 7, 2], [10, 7, 5]]}]");

  EXPECT_EQ(world.cone_distance_m({3, 3}, 0.0, 0.1, 5.0, 0.0), 0.0);
  EXPECT_EQ(world.cone_distance_m({7.2, 7}, 0.0, 0.1, 5.0, 0.0), 0.0);
  EXPECT_EQ(world.cone_distance_m({7, 5}, 0.0, 0.1, 5.0, 10.0), 0.0);
}

TEST(Cone, FollowsAMovingObstacle) {
  // It reaches x = 6 after 10 of its 20 s on the way from 4 to 8.
  const World world = make_world("moving: [{circle: [4, 8, 0.5], path: [[0, 4, 8], [20, 8, 8]]}]");

  EXPECT_NEAR(world.cone_distance_m({6, 5}, radians(90.0), radians(5.0), 6.0, 10.0), 2.5,
              kRounding);
}

TEST(Cone, MeasuresTheBoundary) {
  const World world = make_world("");

  EXPECT_NEAR(world.cone_distance_m({3, 4}, radians(180.0), radians(7.5), 8.0, 0.0), 3.0,
              kRounding);
  EXPECT_NEAR(world.cone_distance_m({3, 4}, radians(-90.0), radians(7.5), 8.0, 0.0), 4.0,
              kRounding);
}

TEST(Cone, IsCappedAtTheRange) {
  const World world = make_world("");

  EXPECT_EQ(world.cone_distance_m({5, 5}, 0.0, radians(7.5), 1.65, 0.0), 1.65);
}

TEST(Cone, OfNoWidthIsARay) {
  const World world = make_world("walls: [[7, 4, 7, 6]]");

  EXPECT_NEAR(world.cone_distance_m({5, 5}, 0.3, 0.0, 4.0, 0.0), 2.0 / core::cos(0.3), kRounding);
}

TEST(Cone, ARayNeverSlipsBetweenTwoWallsThatJoin) {
  // A ring of many short walls around the apex, and rays at and beside the joints.
  std::string walls = "walls: [";
  std::vector<Vec2> joints;
  constexpr int kCount = 360;
  for (int i = 0; i <= kCount; ++i) {
    joints.push_back(Vec2(5, 5) + 3.0 * core::direction(2.0 * core::kPi * (i % kCount) / kCount));
  }
  for (int i = 0; i < kCount; ++i) {
    const auto a = static_cast<std::size_t>(i);
    walls += fmt::format("[{}, {}, {}, {}],", joints[a].x(), joints[a].y(), joints[a + 1].x(),
                         joints[a + 1].y());
  }
  const World world = make_world(walls + "]");

  for (const Vec2& joint : joints) {
    const double bearing = core::bearing_rad({5.1, 4.9, 0.0}, joint);
    for (const double beside : {0.0, 1e-16, -1e-16, 1e-15, -1e-15}) {
      EXPECT_LT(world.cone_distance_m({5.1, 4.9}, bearing + beside, 0.0, 4.0, 0.0), 3.5);
    }
  }
}

TEST(Cone, TurnedIsTheSameAsMadeThere) {
  const World world = random_world(7, false);
  const ConeDirection left = ConeDirection::of(radians(30.0), radians(7.5));

  for (int i = 0; i < 100; ++i) {
    const double heading = 0.06 * i;
    const double turned =
        world.cone_distance_m({0.4, 0.4}, left.turned(core::direction(heading)), 9.0, 0.0);
    const double made =
        world.cone_distance_m({0.4, 0.4}, heading + radians(30.0), radians(7.5), 9.0, 0.0);
    // Directions differ in their last bits; a grazed end may magnify that.
    EXPECT_NEAR(turned, made, 1e-9);
  }
}

// Points on everything that can be seen, `spacing_m` apart.
std::vector<Vec2> sample_surfaces(const World& world, double spacing_m, double time_s) {
  std::vector<Vec2> points;
  for (const World::Segment& s : all_segments(world)) {
    const int steps = 1 + static_cast<int>(core::length(s.b - s.a) / spacing_m);
    for (int i = 0; i <= steps; ++i) points.push_back(s.a + (s.b - s.a) * i / steps);
  }
  std::vector<World::Circle> circles = world.circles();
  for (const MovingObstacle& m : world.moving()) {
    circles.push_back({m.position_at(time_s), m.radius_m});
  }
  for (const World::Circle& c : circles) {
    const int steps = 8 + static_cast<int>(2.0 * core::kPi * c.radius_m / spacing_m);
    for (int i = 0; i < steps; ++i) {
      points.push_back(c.centre + c.radius_m * core::direction(2.0 * core::kPi * i / steps));
    }
  }
  return points;
}

double nearest_sample(const std::vector<Vec2>& samples, const Vec2& apex, double bearing,
                      double half_angle, double range) {
  double nearest = range;
  for (const Vec2& p : samples) {
    const double distance = core::length(p - apex);
    if (distance >= nearest) continue;
    const double off =
        core::wrap_angle_rad(core::atan2(p.y() - apex.y(), p.x() - apex.x()) - bearing);
    if (std::fabs(off) <= half_angle) nearest = distance;
  }
  return nearest;
}

// The exact distance lies between what samples in the cone show, which can only be too far, and
// what samples in a cone wider by one spacing show, which can be too near by one spacing.
TEST(Cone, AgreesWithDenseSamplingInRandomWorlds) {
  constexpr double kSpacing_m = 0.002;
  int inside = 0;
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const World world = random_world(seed, true);
    Dice dice(1000 + seed);
    const double time_s = dice.between(0.0, 40.0);
    const auto samples = sample_surfaces(world, kSpacing_m, time_s);
    for (int query = 0; query < 25; ++query) {
      const Vec2 apex = dice.point(0.1, 9.9);
      const double bearing = dice.between(-core::kPi, core::kPi);
      const double half_angle = dice.between(0.0, 1.5);
      const double range = dice.between(0.5, 8.0);

      const double exact = world.cone_distance_m(apex, bearing, half_angle, range, time_s);

      if (world.clearance_m(apex, range, time_s) == 0.0) {
        EXPECT_EQ(exact, 0.0);
        ++inside;
        continue;
      }
      EXPECT_LE(exact, nearest_sample(samples, apex, bearing, half_angle, range) + 1e-9);
      const double wider = half_angle + kSpacing_m / exact;
      EXPECT_GE(exact, nearest_sample(samples, apex, bearing, wider, range) - kSpacing_m);
      seen += exact < range ? 1 : 0;
    }
  }
  // The test looked at what it is about.
  EXPECT_GT(seen, 500);
  EXPECT_GT(inside, 20);
}

TEST(Cone, TheIndexFindsExactlyWhatLookingAtAllFinds) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const World world = random_world(seed, false);
    const auto segments = all_segments(world);
    Dice dice(2000 + seed);
    for (int query = 0; query < 200; ++query) {
      const Vec2 apex = dice.point(0.1, 9.9);
      const auto direction =
          ConeDirection::of(dice.between(-core::kPi, core::kPi), dice.between(0.0, 0.5));
      const double range = dice.between(0.5, 8.0);
      if (world.clearance_m(apex, range, 0.0) == 0.0) continue;
      const Cone cone(apex, direction);
      double nearest = kInfinity;
      for (const auto& s : segments) {
        nearest = std::min(nearest, cone.squared_distance(s, kInfinity));
      }
      for (const auto& c : world.circles()) {
        nearest = std::min(nearest, cone.squared_distance(c, kInfinity));
      }
      const double expected = nearest < range * range ? std::sqrt(nearest) : range;

      EXPECT_EQ(world.cone_distance_m(apex, direction, range, 0.0), expected);
    }
  }
}

}  // namespace
}  // namespace clew::world
