// SPDX-License-Identifier: Apache-2.0
#include "world/ray_fan.hpp"

#include <gtest/gtest.h>

#include "core/angle.hpp"
#include "random_world.hpp"

namespace clew::world {
namespace {

using core::radians;

/// What each ray finds when it is asked for alone.
std::vector<double> ray_by_ray(const World& world, const Pose2& pose, const RayFan& fan,
                               double reach_m, double time_s) {
  const Vec2 heading = core::direction(pose.heading_rad);
  std::vector<double> distances_m;
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const ConeDirection ray{fan.axis(i), Vec2::UnitX()};
    distances_m.push_back(
        world.cone_distance_m(pose.position(), ray.turned(heading), reach_m, time_s));
  }
  return distances_m;
}

std::vector<double> by_fan(const World& world, const Pose2& pose, const RayFan& fan, double reach_m,
                           double time_s) {
  std::vector<double> distances_m;
  world.fan_distances_m(pose, fan, reach_m, time_s, distances_m);
  return distances_m;
}

TEST(RayFan, FindsWhatItsRaysFindAlone) {
  const RayFan fans[] = {{radians(90.0), radians(-0.5), 361},
                         {radians(180.0), radians(-1.0), 361},
                         {radians(-180.0), radians(0.7), 515},
                         {radians(90.0), radians(-90.0), 4}};
  Dice dice(1);
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const World world = random_world(seed, true);
    for (int pose_number = 0; pose_number < 10; ++pose_number) {
      const Vec2 place = dice.point(0.0, 10.0);
      const Pose2 pose{place.x(), place.y(), dice.between(-core::kPi, core::kPi)};
      const double reach_m = dice.between(0.5, 6.0);
      const double time_s = dice.between(0.0, 20.0);
      for (const RayFan& fan : fans) {
        ASSERT_EQ(by_fan(world, pose, fan, reach_m, time_s),
                  ray_by_ray(world, pose, fan, reach_m, time_s))
            << "seed " << seed << ", pose " << pose_number;
      }
    }
  }
}

TEST(RayFan, SeesWhatLiesAcrossItsFirstRay) {
  // A wall from 100 to 80 degrees; the fan begins at 90 and goes clockwise, all around.
  const World world = make_world("walls: [[4.9, 6, 5.1, 6]]");
  const RayFan fan(radians(90.0), radians(-1.0), 361);

  const std::vector<double> distances_m = by_fan(world, {5, 5, 0}, fan, 3.0, 0.0);

  EXPECT_NEAR(distances_m.front(), 1.0, 1e-12);
  EXPECT_NEAR(distances_m.back(), 1.0, 1e-12);
  EXPECT_NEAR(distances_m[5], 1.0 / core::cos(radians(5.0)), 1e-12);
  EXPECT_NEAR(distances_m[355], 1.0 / core::cos(radians(5.0)), 1e-12);
  EXPECT_EQ(distances_m[6], 3.0);  // 0.1 / 1 is the tangent of 5.7 degrees
}

TEST(RayFan, ReadsZeroOnAWallAndInsideAnObstacle) {
  const World world = make_world("walls: [[5, 5, 6, 5]]\npolygons: [[[1, 1], [2, 1], [2, 2]]]");
  const RayFan fan(radians(90.0), radians(-45.0), 5);

  EXPECT_EQ(by_fan(world, {5, 5, 0}, fan, 3.0, 0.0), std::vector<double>(5, 0.0));
  EXPECT_EQ(by_fan(world, {1.5, 1.2, 0}, fan, 3.0, 0.0), std::vector<double>(5, 0.0));
}

}  // namespace
}  // namespace clew::world
