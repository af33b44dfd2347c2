// SPDX-License-Identifier: Apache-2.0
#include "drive/stretch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/angle.hpp"
#include "core/random.hpp"

namespace clew::drive {
namespace {

constexpr double kRadius_m = 0.15;

world::World make_world(const std::string& obstacles) {
  auto world =
      world::World::parse("format: clew-world/1\nname: test\nbounds: [0, 0, 20, 20]\n" + obstacles +
                              "\nstart: [1, 1, 0]\ntarget: [19, 19]\ntarget_radius: 0.2\n",
                          "test.yaml");
  EXPECT_TRUE(world.ok()) << world.error().text();
  return std::move(world).value();
}

TEST(Stretch, EndsWhereItsArcEnds) {
  // Half a circle of 1 m to the right, from (5, 5) heading up.
  const Stretch stretch({5, 5, core::radians(90.0)}, core::kPi, core::radians(-180.0), 0.0, 1.0);

  EXPECT_NEAR(stretch.at(0.5).x(), 6.0, 1e-12);
  EXPECT_NEAR(stretch.at(0.5).y(), 6.0, 1e-12);
  EXPECT_NEAR(stretch.at(1.0).x(), 7.0, 1e-12);
  EXPECT_NEAR(stretch.at(1.0).y(), 5.0, 1e-12);
}

TEST(Stretch, GoesOverIntoAStraightWayAsItBendsLess) {
  const Stretch straight({5, 5, 0.3}, 0.5, 0.0, 0.0, 1.0);
  const Stretch bent({5, 5, 0.3}, 0.5, 1e-9, 0.0, 1.0);

  EXPECT_NEAR(bent.at(1.0).x(), straight.at(1.0).x(), 1e-9);
  EXPECT_NEAR(bent.at(1.0).y(), straight.at(1.0).y(), 1e-9);
}

TEST(Stretch, PassesAnObstacleThatItsChordWouldMeet) {
  // Half a circle of 1 m around a post at its centre's height, which lies on the chord.
  const world::World world = make_world("circles: [[6, 5, 0.1]]");
  const Stretch around({5, 5, core::radians(90.0)}, core::kPi, core::radians(-180.0), 0.0, 1.0);

  EXPECT_FALSE(around.sweep(world, kRadius_m).contact);
}

TEST(Stretch, MeetsAnObstacleThatItsChordWouldPass) {
  const world::World world = make_world("circles: [[6, 6.3, 0.2]]");
  const Stretch around({5, 5, core::radians(90.0)}, core::kPi, core::radians(-180.0), 0.0, 1.0);

  const world::Sweep sweep = around.sweep(world, kRadius_m);

  // Centres 1 and 1.3 m from (6, 5), and 0.35 m apart: cos(angle) = (1 + 1.69 - 0.1225) / 2.6
  // before the top of the circle.
  const double before_top_rad = core::acos((1.0 + 1.69 - 0.1225) / 2.6);
  EXPECT_TRUE(sweep.contact);
  EXPECT_NEAR(sweep.free_fraction, (core::radians(90.0) - before_top_rad) / core::kPi, 1e-5);
  EXPECT_NEAR(sweep.contact_point.y(), 6.3 - 0.2, 0.05);
}

/// Arcs in rooms full of posts and walls, against the clearance along a thousand places of each.
TEST(Stretch, NeverTouchesAndNeverStopsEarly) {
  const core::Random random({7, 0, 0, 0});
  std::uint32_t next = 0;
  const auto between = [&](double low, double high) {
    return low + (high - low) * random.uniform(next++);
  };
  int stopped = 0;
  for (int room = 0; room < 40; ++room) {
    std::string walls = "walls: [";
    std::string circles = "circles: [";
    for (int i = 0; i < 12; ++i) {
      const double x = between(3, 7);
      const double y = between(3, 7);
      walls += (i > 0 ? ", [" : "[") + std::to_string(x) + ", " + std::to_string(y) + ", " +
               std::to_string(x + between(-0.5, 0.5)) + ", " +
               std::to_string(y + between(-0.5, 0.5)) + "]";
      circles += (i > 0 ? ", [" : "[") + std::to_string(between(3, 7)) + ", " +
                 std::to_string(between(3, 7)) + ", 0.1]";
    }
    const world::World world = make_world(walls + "]\n" + circles + "]\n" + "about: random");
    for (int way = 0; way < 25; ++way) {
      const core::Pose2 from{between(3, 7), between(3, 7), between(-3.1, 3.1)};
      if (world.clearance_m(from.position(), 1.0, 0.0) <= kRadius_m) continue;
      const Stretch arc(from, between(-1.0, 1.0), between(-3.0, 3.0), 0.0, 1.0);

      const world::Sweep sweep = arc.sweep(world, kRadius_m);

      stopped += sweep.contact ? 1 : 0;
      for (int i = 0; i <= 1000; ++i) {
        const core::Vec2 place = arc.at(sweep.free_fraction * i / 1000.0);
        ASSERT_GE(world.clearance_m(place, 1.0, 0.0), kRadius_m) << room << ' ' << way;
      }
      if (sweep.contact) {
        // The grown disc touches on its chord, which the robot's place is off by less than the
        // rise.
        EXPECT_LE(world.clearance_m(arc.at(sweep.free_fraction), 1.0, 0.0),
                  kRadius_m + 2.0 * Stretch::kRise_m + 1e-8);
      }
    }
  }
  EXPECT_GT(stopped, 100);
}

TEST(Stretch, MeetsAMovingObstacle) {
  // A disc of 0.2 m falls from (6, 7) at 1 m/s, and reaches (6, 6.35) as the robot reaches the top
  // of its half circle, (6, 6), after half of 1.3 s.
  const world::World world =
      make_world("moving: [{circle: [6, 7, 0.2], path: [[0, 6, 7], [2, 6, 5]], loop: false}]");
  const Stretch around({5, 5, core::radians(90.0)}, core::kPi, core::radians(-180.0), 0.0, 1.3);

  const world::Sweep sweep = around.sweep(world, kRadius_m);

  EXPECT_TRUE(sweep.contact);
  EXPECT_TRUE(sweep.moving_obstacle);
  EXPECT_NEAR(sweep.free_fraction, 0.5, 1e-4);
}

}  // namespace
}  // namespace clew::drive
