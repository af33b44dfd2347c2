// SPDX-License-Identifier: Apache-2.0
#include "plan/astar_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "plan/known_map.hpp"
#include "world/world.hpp"

namespace clew::plan {
namespace {

using core::Vec2;

constexpr double kRadius_m = 0.15;
const Vec2 kStart(1.0, 2.0);
constexpr char kWall[] = "walls: [[3, 0, 3, 3.2]]";

/// A room of 6 m x 4 m with `obstacles`, and a planner that knows them.
class Room {
 public:
  explicit Room(const std::string& obstacles, const AStarPlannerParameters& parameters = {})
      : parameters_(parameters), planner_(make_planner()) {
    auto world =
        world::World::parse("format: clew-world/1\nname: room\nbounds: [0, 0, 6, 4]\n" + obstacles +
                                "\nstart: [1, 2, 0]\ntarget: [5, 2]\ntarget_radius: 0.1\n",
                            "room.yaml");
    EXPECT_TRUE(world.ok()) << world.error().text();
    world_ = std::make_shared<const world::World>(std::move(world).value());
    map_ = WorldMap::create(world_, 0.05, {kRadius_m, 0.1}).value();
  }

  std::unique_ptr<AStarPlanner> make_planner() const {
    domain::BehaviourSetup setup;
    setup.tick_s = 0.1;
    return AStarPlanner::create(parameters_, setup).value();
  }
  Subgoal step(const Vec2& robot, double speed_mps = 0.0) {
    return step(robot, speed_mps, *planner_);
  }
  Subgoal step(const Vec2& robot, double speed_mps, AStarPlanner& planner) {
    domain::Odometry odometry;
    odometry.stamp.tick = tick_++;
    odometry.pose_odom_robot = {robot.x(), robot.y(), 0.0};
    odometry.speed_mps = speed_mps;
    return planner.step({odometry, *map_, world_->target(), world_->target_radius_m(), {}});
  }
  /// Goes to the pursued place as far as a tick lets it, and says how far it is to the target.
  double walk() {
    constexpr double kStep_m = 0.05;
    Vec2 robot = kStart;
    double length_m = 0.0;
    for (int ticks = 0; ticks < 1000; ++ticks) {
      if (core::length(world_->target() - robot) <= world_->target_radius_m()) return length_m;
      const Vec2 way = step(robot, kStep_m / 0.1).place - robot;
      const Vec2 next = robot + std::min(1.0, kStep_m / core::length(way)) * way;
      // A line leads over cells whose middles have room: half a diagonal less between them.
      const double sure_m = kRadius_m - std::sqrt(0.5) * 0.05;
      EXPECT_EQ(world_->sweep_disc(robot, next, sure_m, 0.0, 0.0).free_fraction, 1.0);
      length_m += core::length(next - robot);
      robot = next;
    }
    return HUGE_VAL;
  }
  AStarPlanner& planner() { return *planner_; }

 private:
  AStarPlannerParameters parameters_;
  std::shared_ptr<const world::World> world_;
  std::unique_ptr<WorldMap> map_;
  std::unique_ptr<AStarPlanner> planner_;
  std::uint64_t tick_ = 0;
};

TEST(AStarPlanner, PursuesAPlaceAheadOnTheStraightLine) {
  Room room("");

  EXPECT_NEAR(core::length(room.step(kStart).place - Vec2(1.25, 2.0)), 0.0, 1e-9);
}

TEST(AStarPlanner, LooksFartherAheadTheFasterItGoesWithinBounds) {
  Room room("");

  EXPECT_NEAR(room.step(kStart, 0.5).place.x(), 1.5, 1e-9);
  EXPECT_NEAR(room.step(kStart, 2.0).place.x(), 1.8, 1e-9);
}

TEST(AStarPlanner, ReachesTheTargetOnTheShortestWay) {
  // In steps of 0.05 m, the last of which ends within the radius.
  EXPECT_NEAR(Room("").walk(), 3.9, 0.06);

  // Around the wall's end at (3, 3.2), 0.15 m to 0.25 m from it: sqrt(2^2 + 1.4^2) twice is 4.88 m.
  const double around_m = Room(kWall).walk();
  EXPECT_GT(around_m, 4.7);
  EXPECT_LT(around_m, 5.1);
}

TEST(AStarPlanner, GoesThroughAGapThatLeavesNoMargin) {
  // 0.36 m wide, for a disc of 0.3 m.
  EXPECT_LT(Room("walls: [[3, 0, 3, 1.80], [3, 2.16, 3, 4]]").walk(), 4.1);
}

TEST(AStarPlanner, DoesNotPursueAPlaceBehindACorner) {
  AStarPlannerParameters parameters;
  parameters.least_look_ahead_m = 0.8;
  Room room(kWall, parameters);

  // Just below the corner, the place 0.8 m ahead on the path lies behind the wall.
  const Vec2 robot(2.8, 3.1);
  const Vec2 place = room.step(robot).place;

  EXPECT_LT(core::length(place - robot), 0.7);
}

TEST(AStarPlanner, TheTargetItselfIsTheSubgoalWhereThereIsNoWay) {
  Room room("walls: [[3, 0, 3, 4]]");

  const Subgoal subgoal = room.step(kStart);

  EXPECT_EQ(subgoal.place, Vec2(5.0, 2.0));
  EXPECT_EQ(subgoal.radius_m, 0.1);
}

TEST(AStarPlanner, ClosesAPlaceBeforeWhichItIsHeld) {
  AStarPlannerParameters parameters;
  parameters.held_s = 1.0;
  Room room("walls: [[3, 0, 3, 1.80], [3, 2.16, 3, 3.2]]", parameters);
  const Vec2 before_gap(2.8, 1.98);
  const Vec2 into_gap = room.step(before_gap).place;
  ASSERT_GT(into_gap.x(), 2.9);
  for (int ticks = 0; ticks < 11; ++ticks) ASSERT_EQ(room.step(before_gap).place, into_gap);

  // Held for more than a second and for 12 ticks, whatever the map says: it leads
  // there another way.
  EXPECT_NE(room.step(before_gap).place, into_gap);
}

TEST(AStarPlanner, GoesOnFromASavedState) {
  Room room(kWall);
  room.step(kStart);
  room.step({1.2, 2.2});
  core::StateWriter writer;
  room.planner().save(writer);
  const auto restored = room.make_planner();
  core::StateReader reader(writer.bytes());

  restored->load(reader);

  ASSERT_TRUE(reader.complete());
  EXPECT_EQ(room.step({1.4, 2.4}, 0.5, *restored).place, room.step({1.4, 2.4}, 0.5).place);
}

TEST(AStarPlanner, RefusesAStateWhosePieceIsNoneOfThePath) {
  AStarPlanner::State state;
  state.path = {kStart, {5.0, 2.0}};
  state.piece = 2;
  core::StateWriter writer;
  writer(state);
  core::StateReader reader(writer.bytes());

  Room("").make_planner()->load(reader);

  EXPECT_FALSE(reader.ok());
}

TEST(AStarPlanner, RefusesBoundsThatCross) {
  AStarPlannerParameters parameters;
  parameters.least_look_ahead_m = 2.0;

  const auto planner = AStarPlanner::create(parameters, {});

  ASSERT_FALSE(planner.ok());
  EXPECT_EQ(planner.error().message,
            "plan.astar: least_look_ahead_m must not be greater than most_look_ahead_m");
}

}  // namespace
}  // namespace clew::plan
