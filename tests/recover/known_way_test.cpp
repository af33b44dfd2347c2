// SPDX-License-Identifier: Apache-2.0
#include "recover/known_way.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "map/astar.hpp"
#include "map/neural_path.hpp"

namespace clew::recover {
namespace {

/// A robot in the corner of a room of 1.5 m by 2 m, with thin walls and a gap of 0.36 m in the one
/// at x = 0.5 m, with its middle at y = 0: a laser of 4 m, with a ray a degree.
struct BeforeAGap {
  BeforeAGap() {
    const core::Vec2 place(-0.3, 0.5);
    odometry.pose_odom_robot = {place.x(), place.y(), 0.0};
    scan.bearing_first_rad = core::radians(-179.5);
    scan.bearing_step_rad = core::radians(1.0);
    scan.range_max_m = 4.0;
    for (std::size_t i = 0; i < 360; ++i) {
      const core::Vec2 ray = core::direction(scan.bearing_rad(i));
      const double along_x_m = ((ray.x() > 0.0 ? 0.5 : -1.0) - place.x()) / ray.x();
      const double along_y_m = ((ray.y() > 0.0 ? 1.0 : -1.0) - place.y()) / ray.y();
      const double wall_m = std::min(along_x_m, along_y_m);
      const core::Vec2 end = place + wall_m * ray;
      const bool through = end.x() > 0.49 && std::fabs(end.y()) < 0.18;
      scan.ranges_m.push_back(through ? 4.0 : wall_m - 0.15);
    }
  }
  Situation situation() const {
    const core::Vec2 target(1.5, -0.8);
    return {0, odometry, scan, nullptr, target, target, 0.2, &surroundings};
  }

  domain::Odometry odometry;
  domain::Scan scan;
  Surroundings surroundings{{}, 0.15};
};

TEST(KnownWay, LeadsThroughANarrowGapInItsMiddle) {
  for (const bool neural : {false, true}) {
    BeforeAGap scene;
    scene.surroundings.see(scene.odometry, scene.scan);
    std::unique_ptr<map::PathSearch> search = std::make_unique<map::AStar>();
    if (neural) search = std::make_unique<map::NeuralPath>(map::NeuralMap::create({}).value());
    domain::BehaviourSetup setup;
    setup.robot.radius_m = 0.15;
    KnownWay way({}, setup, std::move(search));

    way.plan(scene.situation());

    // The middles of the cells of 5 cm are at +-25 mm, where only 5 mm are left beside the robot.
    ASSERT_TRUE(way.has_way());
    core::Vec2 corner = way.next_corner(scene.situation(), 0.02);
    for (int i = 0; i < 20 && corner.x() < 0.35; ++i) {
      scene.odometry.pose_odom_robot = {corner.x(), corner.y(), 0.0};
      corner = way.next_corner(scene.situation(), 0.02);
    }
    EXPECT_NEAR(corner.x(), 0.5, 0.15) << neural;
    EXPECT_NEAR(corner.y(), 0.0, 0.013) << neural;
  }
}

}  // namespace
}  // namespace clew::recover
