// SPDX-License-Identifier: Apache-2.0
#include "map/local_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "core/angle.hpp"
#include "map/astar.hpp"
#include "map/neural_path.hpp"

namespace clew::map {
namespace {

constexpr double kRadius_m = 0.15;
constexpr double kTick_s = 0.3;

LocalPath astar_path(const LocalPathParameters& parameters = {}) {
  return LocalPath(parameters, kRadius_m, kTick_s, std::make_unique<AStar>());
}

/// A robot in the corner of a room of 1.5 m by 2 m, with thin walls and, if it has one, a gap of
/// 0.36 m in the one at x = 0.5 m, with its middle at y = 0: a laser of 4 m, with a ray a degree.
class Room {
 public:
  explicit Room(bool has_gap = true) {
    odometry_.pose_odom_robot = {place_.x(), place_.y(), 0.0};
    scan_.bearing_first_rad = core::radians(-179.5);
    scan_.bearing_step_rad = core::radians(1.0);
    scan_.range_max_m = 4.0;
    for (std::size_t i = 0; i < 360; ++i) {
      const Vec2 ray = core::direction(scan_.bearing_rad(i));
      const double along_x_m = ((ray.x() > 0.0 ? 0.5 : -1.0) - place_.x()) / ray.x();
      const double along_y_m = ((ray.y() > 0.0 ? 1.0 : -1.0) - place_.y()) / ray.y();
      const double wall_m = std::min(along_x_m, along_y_m);
      const Vec2 end = place_ + wall_m * ray;
      const bool through = has_gap && end.x() > 0.49 && std::fabs(end.y()) < 0.18;
      scan_.ranges_m.push_back(through ? 4.0 : wall_m - kRadius_m);
    }
    map_.see(odometry_, scan_);
  }

  /// The target lies behind the wall with the gap.
  PathRequest request(std::uint64_t tick = 0) const {
    return {tick, place_, {1.5, -0.8}, 0.2, map_};
  }
  const Vec2& place() const { return place_; }

 private:
  Vec2 place_ = Vec2(-0.3, 0.5);
  domain::Odometry odometry_;
  domain::Scan scan_;
  LocalMap map_{{}, kRadius_m};
};

/// Nothing was seen yet: the robot at the origin, the target 3 m ahead.
class OpenPlane {
 public:
  PathRequest request(std::uint64_t tick = 0) const {
    return {tick, Vec2::Zero(), {3.0, 0.0}, 0.2, map_};
  }
  /// Sees a wall across the straight path, from 0.35 m on either side, `distance_m` ahead of the
  /// robot's centre, at the end of rays that are a degree apart.
  void see_a_wall(double distance_m) {
    domain::Scan scan;
    scan.bearing_first_rad = core::radians(-20.0);
    scan.bearing_step_rad = core::radians(1.0);
    scan.range_max_m = 4.0;
    for (std::size_t i = 0; i <= 40; ++i) {
      const double wall_m = distance_m / core::cos(scan.bearing_rad(i));
      scan.ranges_m.push_back(wall_m - kRadius_m);
    }
    map_.see({}, scan);
  }

 private:
  LocalMap map_{{}, kRadius_m};
};

TEST(LocalPath, LeadsThroughANarrowGapInItsMiddle) {
  for (const bool neural : {false, true}) {
    const Room room;
    std::unique_ptr<PathSearch> search = std::make_unique<AStar>();
    if (neural) search = std::make_unique<NeuralPath>(NeuralMap::create({}).value());
    LocalPath path({}, kRadius_m, kTick_s, std::move(search));

    path.plan(room.request());

    // The middles of the cells of 5 cm are at +-25 mm, where only 5 mm are left beside the robot.
    ASSERT_TRUE(path.exists());
    Vec2 corner = room.place();
    for (int i = 0; i < 20 && corner.x() < 0.35; ++i) {
      corner = path.next_corner({corner.x(), corner.y(), 0.0}, 0.02);
    }
    EXPECT_NEAR(corner.x(), 0.5, 0.15) << neural;
    EXPECT_NEAR(corner.y(), 0.0, 0.013) << neural;
  }
}

TEST(LocalPath, DoesNotExistWhereHitsCloseEveryWay) {
  const Room closed(false);
  LocalPath path = astar_path();

  path.plan(closed.request());

  EXPECT_FALSE(path.exists());
}

TEST(LocalPath, IsStraightThroughTheUnknown) {
  const OpenPlane plane;
  LocalPath path = astar_path();

  path.plan(plane.request());

  // From the robot to within 0.8 of the target's radius, and a cell's middle beside the line.
  ASSERT_EQ(path.corners_odom().size(), 2u);
  EXPECT_EQ(path.corners_odom().front(), Vec2(0.0, 0.0));
  EXPECT_LE(core::length(path.corners_odom().back() - Vec2(3.0, 0.0)), 0.16);
}

TEST(LocalPath, IsSoughtAgainWhenItIsOld) {
  const OpenPlane plane;
  LocalPathParameters parameters;
  parameters.replan_s = 3.0;  // ten ticks
  LocalPath path = astar_path(parameters);

  EXPECT_TRUE(path.keep_up(plane.request(100)));
  EXPECT_FALSE(path.keep_up(plane.request(101)));
  EXPECT_FALSE(path.keep_up(plane.request(109)));
  EXPECT_TRUE(path.keep_up(plane.request(110)));
  EXPECT_FALSE(path.keep_up(plane.request(111)));
}

TEST(LocalPath, IsSoughtAgainWhenSomethingLiesOnItsNextPiece) {
  OpenPlane plane;
  LocalPath path = astar_path();
  path.keep_up(plane.request(0));

  plane.see_a_wall(0.8);

  // Within the look-ahead of 1 m, and the path is a tick old.
  EXPECT_TRUE(path.keep_up(plane.request(1)));
  EXPECT_TRUE(path.exists());
  EXPECT_FALSE(path.keep_up(plane.request(2)));  // the new one leads round it
}

TEST(LocalPath, LeavesAloneWhatLiesBeyondTheLookAhead) {
  OpenPlane plane;
  LocalPath path = astar_path();
  path.keep_up(plane.request(0));

  plane.see_a_wall(1.5);

  EXPECT_FALSE(path.keep_up(plane.request(1)));
}

TEST(LocalPath, IsSoughtAgainAfterItWasForgotten) {
  const OpenPlane plane;
  LocalPath path = astar_path();
  path.keep_up(plane.request(0));

  path.forget_path();

  EXPECT_TRUE(path.keep_up(plane.request(1)));
}

TEST(LocalPath, DoesNotLeadThroughPlacesThatWereRefused) {
  const Room room;
  LocalPath path = astar_path();
  // Across the gap, closer together than the reach of a place that was refused.
  for (double y_m = -0.2; y_m <= 0.2; y_m += 0.05) path.refuse({0.5, y_m});

  path.plan(room.request());
  EXPECT_FALSE(path.exists());

  path.forget_all();
  path.plan(room.request());
  EXPECT_TRUE(path.exists());
}

TEST(LocalPath, TellsTheCostsByWhichItSeeksAndIsNotChangedByThat) {
  const Room room;
  const Vec2 gap(0.5, 0.0);
  const auto cost_at = [&](const LocalPath& path, const Vec2& place) {
    const Costmap costs = path.costs_around(room.request(), 2.0);
    return costs.cost[costs.grid.index(costs.grid.cell_at(place).value())];
  };
  LocalPath path = astar_path();
  path.plan(room.request());
  const auto corners = path.corners_odom();

  // Beside the posts of the gap there is less room than in the open.
  EXPECT_GT(cost_at(path, gap), cost_at(path, {-0.3, 0.0}));
  EXPECT_EQ(cost_at(path, {0.5, 0.6}), Costmap::kBlocked);
  EXPECT_EQ(path.corners_odom(), corners);

  path.refuse(gap);
  EXPECT_EQ(cost_at(path, gap), Costmap::kBlocked);
}

TEST(LocalPath, BeginsWhereTheRobotStandsWhateverIsBelievedOfThatPlace) {
  const Room room;
  LocalPath path = astar_path();
  path.refuse(room.place());

  path.plan(room.request());

  ASSERT_TRUE(path.exists());
  EXPECT_EQ(path.corners_odom().front(), room.place());
}

TEST(LocalPath, TellsItsLengthFromTheRobotOn) {
  const OpenPlane plane;
  LocalPath path = astar_path();
  path.plan(plane.request());
  const double whole_m = core::length(path.corners_odom().back());

  EXPECT_NEAR(path.length_m({0.0, 0.0}), whole_m, 1e-12);
  EXPECT_NEAR(path.length_m(0.5 * path.corners_odom().back()), 0.5 * whole_m, 1e-12);
}

TEST(LocalPath, TellsHowMuchItLeadsAwayFromTheTarget) {
  const OpenPlane plane;
  LocalPath straight = astar_path();
  straight.plan(plane.request());
  const Room room;
  LocalPath round = astar_path();
  round.plan(room.request());

  EXPECT_EQ(straight.rise_m({0.0, 0.0}, {3.0, 0.0}), 0.0);
  // A robot that turned its back on the target: from 1 m before it to the path's end behind.
  const Vec2 end = straight.corners_odom().back();
  EXPECT_NEAR(straight.rise_m({0.0, 0.0}, {1.0, 0.0}), core::length(end - Vec2(1.0, 0.0)), 0.05);
  EXPECT_LT(round.rise_m(room.place(), {1.5, -0.8}), 0.02);  // through the gap it only approaches
}

TEST(LocalPath, StaysAtItsLastCorner) {
  const OpenPlane plane;
  LocalPath path = astar_path();
  path.plan(plane.request());
  const Vec2 end = path.corners_odom().back();

  EXPECT_EQ(path.next_corner({end.x(), end.y(), 0.0}, 1.0), end);
  EXPECT_EQ(path.next_corner({end.x(), end.y(), 0.0}, 1.0), end);
}

TEST(LocalPath, IsTheSameAfterLoading) {
  const Room room;
  LocalPath path = astar_path();
  path.keep_up(room.request(7));
  path.refuse({2.0, 2.0});
  core::StateWriter writer;
  path.save(writer);
  LocalPath restored = astar_path();
  core::StateReader reader(writer.bytes());

  restored.load(reader);

  ASSERT_TRUE(reader.complete());
  EXPECT_EQ(restored.corners_odom(), path.corners_odom());
  EXPECT_FALSE(restored.keep_up(room.request(8)));  // it is not old
  core::StateWriter again;
  restored.save(again);
  core::StateWriter before;
  path.save(before);
  EXPECT_EQ(again.bytes(), before.bytes());
}

}  // namespace
}  // namespace clew::map
