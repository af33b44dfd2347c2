// SPDX-License-Identifier: Apache-2.0
#include "plan/neural_map_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/segment.hpp"
#include "plan/known_map.hpp"
#include "world/world.hpp"

namespace clew::plan {
namespace {

constexpr double kRadius_m = 0.15;

/// A room of 6 m x 4 m with `obstacles`, and a planner in it.
class Room {
 public:
  explicit Room(const std::string& obstacles, const NeuralMapPlanner::Parameters& parameters = {},
                const std::string& target = "[5, 2]", const std::string& target_radius = "0.1")
      : parameters_(parameters) {
    auto world = world::World::parse("format: clew-world/1\nname: room\nbounds: [0, 0, 6, 4]\n" +
                                         obstacles + "\nstart: [1, 2, 0]\ntarget: " + target +
                                         "\ntarget_radius: " + target_radius + "\n",
                                     "room.yaml");
    EXPECT_TRUE(world.ok()) << world.error().text();
    world_ = std::make_shared<const world::World>(std::move(world).value());
    map_ = WorldMap::create(world_, 0.05, {kRadius_m, 0.1}).value();
    planner_ = make_planner();
  }

  std::unique_ptr<NeuralMapPlanner> make_planner() const {
    domain::BehaviourSetup setup;
    setup.robot.radius_m = kRadius_m;
    setup.tick_s = 0.5;
    return NeuralMapPlanner::create(parameters_, setup).value();
  }
  /// The subgoal in the next tick, with the robot at `robot`.
  Subgoal step(const core::Vec2& robot) { return step(robot, *planner_); }
  Subgoal step(const core::Vec2& robot, NeuralMapPlanner& planner) {
    domain::Odometry odometry;
    odometry.stamp.tick = tick_++;
    odometry.pose_odom_robot = {robot.x(), robot.y(), 0.0};
    return planner.step({odometry, *map_, world_->target(), world_->target_radius_m(), {}});
  }
  /// What is drawn with the robot at `robot`: the layer of this name, if there is one.
  std::optional<domain::PictureLayer> draw(const core::Vec2& robot, const std::string& name) {
    step(robot);
    domain::Odometry odometry;
    odometry.stamp.tick = tick_;
    odometry.pose_odom_robot = {robot.x(), robot.y(), 0.0};
    domain::Inside inside;
    planner_->tell({odometry, *map_, world_->target(), world_->target_radius_m(), {}}, inside);
    for (const domain::PictureLayer& layer : inside.picture.layers) {
      if (layer.name == name) return layer;
    }
    return std::nullopt;
  }
  /// Goes straight from subgoal to subgoal, and says how many there were on the way to the target.
  int walk() {
    core::Vec2 robot = world_->start().position();
    for (int subgoals = 1; subgoals < 100; ++subgoals) {
      const Subgoal next = step(robot);
      EXPECT_EQ(world_->sweep_disc(robot, next.place, kRadius_m, 0.0, 0.0).free_fraction, 1.0)
          << robot.transpose() << " to " << next.place.transpose();
      if (next.place == world_->target()) return subgoals;
      robot = next.place;
    }
    return 100;
  }

  NeuralMapPlanner& planner() { return *planner_; }
  /// Whether a body of the robot's size, but for two millimetres, gets straight from place to
  /// place.
  bool is_free(const core::Vec2& from, const core::Vec2& to) const {
    return world_->sweep_disc(from, to, kRadius_m - 2e-3, 0.0, 0.0).free_fraction == 1.0;
  }

 private:
  NeuralMapPlanner::Parameters parameters_;
  std::shared_ptr<const world::World> world_;
  std::unique_ptr<WorldMap> map_;
  std::unique_ptr<NeuralMapPlanner> planner_;
  std::uint64_t tick_ = 0;
};

constexpr char kWall[] = "walls: [[3, 0, 3, 3.2]]";

TEST(NeuralMapPlanner, SteersForTheTargetWhereNothingIsInTheWay) {
  NeuralMapPlanner::Parameters far_sighted;
  far_sighted.look_ahead_m = 10.0;
  Room room("", far_sighted);

  const Subgoal subgoal = room.step({1.0, 2.0});

  EXPECT_EQ(subgoal.place, core::Vec2(5.0, 2.0));
  EXPECT_EQ(subgoal.radius_m, 0.1);
}

TEST(NeuralMapPlanner, LooksNoFartherThanItMay) {
  Room room("");

  const Subgoal subgoal = room.step({1.0, 2.0});

  // 3 m ahead, less the size of a cell.
  EXPECT_NEAR(core::length(subgoal.place - core::Vec2(1.0, 2.0)), 3.0, 0.05);
  EXPECT_EQ(subgoal.radius_m, 0.3);
}

TEST(NeuralMapPlanner, LeadsAroundAWallByPlacesThatCanBeReachedStraight) {
  for (const map::Lattice lattice :
       {map::Lattice::kFourNeighbours, map::Lattice::kEightNeighbours, map::Lattice::kHexagonal}) {
    NeuralMapPlanner::Parameters parameters;
    parameters.lattice = lattice;
    Room room(kWall, parameters);

    const int subgoals = room.walk();

    EXPECT_GE(subgoals, 2);
    EXPECT_LE(subgoals, 8);
  }
}

TEST(NeuralMapPlanner, GoesThroughAGapThatLeavesNoMargin) {
  // 0.36 m wide, for a disc of 0.3 m.
  Room room("walls: [[3, 0, 3, 1.80], [3, 2.16, 3, 4]]");

  EXPECT_LE(room.walk(), 8);
}

TEST(NeuralMapPlanner, ATargetBesideAWallLetsNoPathPassCornersAsClosely) {
  // Behind the wall, 0.17 m from it: narrow for a disc of 0.15 m.
  const core::Vec2 target(3.17, 1.5);
  const core::Vec2 corner(3.0, 3.2);
  Room room(kWall, {}, "[3.17, 1.5]");
  core::Vec2 robot(1.0, 2.0);

  for (int subgoals = 0; subgoals < 20 && robot != target; ++subgoals) {
    const core::Vec2 next = room.step(robot).place;
    EXPECT_GT(core::distance_to_segment_m(robot, next, corner), 0.2) << next.transpose();
    robot = next;
  }
  EXPECT_EQ(robot, target);
}

TEST(NeuralMapPlanner, GoesIntoANarrowEndFromWhereTheTargetIsStraightAhead) {
  // Between two walls 0.35 m apart and askew to the cells, with no cell's middle within the radius.
  const std::string walls = "walls: [[2.739, 1.861, 2.945, 2.29], [3.055, 1.71, 3.261, 2.139]]";
  Room room(walls, {}, "[3, 2]", "0.02");
  const core::Vec2 target(3.0, 2.0);
  core::Vec2 robot(3.882, 2.797);  // on the axis of the gap
  core::Vec2 last = robot;

  // It stops short of each subgoal, as far as that counts as there.
  for (int tick = 0; tick < 400 && robot != target; ++tick) {
    const core::Vec2 next = room.step(robot).place;
    const core::Vec2 way = next - robot;
    if (next == target) last = robot;
    robot = core::length(way) <= 0.02 || next == target ? next : robot + 0.02 * way.normalized();
  }

  EXPECT_EQ(robot, target);
  EXPECT_TRUE(room.is_free(last, target)) << last.transpose();
}

// The length of the way along subgoals 0.1 m and less apart.
double walked_length_m(bool smooth) {
  NeuralMapPlanner::Parameters parameters;
  parameters.smooth = smooth;
  parameters.look_ahead_m = 0.1;
  parameters.arrive_m = 0.02;
  // The target lies 4 m ahead and 1.6 m to the left: no direction of the lattice.
  Room room("", parameters, "[5, 3.6]");
  core::Vec2 robot(1.0, 2.0);
  double length_m = 0.0;
  for (int subgoals = 0; subgoals < 1000 && robot != core::Vec2(5.0, 3.6); ++subgoals) {
    const core::Vec2 next = room.step(robot).place;
    length_m += core::length(next - robot);
    robot = next;
  }
  EXPECT_EQ(robot, core::Vec2(5.0, 3.6));
  return length_m;
}

TEST(NeuralMapPlanner, LeadsOverTheInterpolatedLandscapeNearlyStraight) {
  // Straight are sqrt(4^2 + 1.6^2) = 4.308 m; from cell to cell, 1.6 m of both axes diagonally and
  // 2.4 m along one: 1.6 sqrt(2) + 2.4 = 4.663 m.
  EXPECT_LT(walked_length_m(true), 4.308 * 1.04);
  EXPECT_NEAR(walked_length_m(false), 4.663, 0.1);
}

TEST(NeuralMapPlanner, KeepsASubgoalUntilItIsNear) {
  Room room(kWall);
  const core::Vec2 subgoal = room.step({1.0, 2.0}).place;
  const core::Vec2 back = (core::Vec2(1.0, 2.0) - subgoal).normalized();

  EXPECT_EQ(room.step(subgoal + 0.5 * back).place, subgoal);
  EXPECT_NE(room.step(subgoal + 0.29 * back).place, subgoal);
}

TEST(NeuralMapPlanner, PlansAnewAfterAWhileOutOfStraightReach) {
  Room room(kWall);
  room.step({1.0, 2.0});
  // Behind the wall's other side, where the subgoal, on this side or above the wall, is hidden.
  const core::Vec2 displaced(3.6, 0.4);
  const core::Vec2 before = room.step(displaced).place;

  // Out of reach from tick 1 on, of 0.5 s: 1.5 s later is tick 4.
  EXPECT_EQ(room.step(displaced).place, before);
  EXPECT_EQ(room.step(displaced).place, before);
  const core::Vec2 after = room.step(displaced).place;

  EXPECT_EQ(after, core::Vec2(5.0, 2.0));  // 2.1 m off, with nothing in between
}

TEST(NeuralMapPlanner, SteersForTheTargetItselfWhereThereIsNoWay) {
  Room room("walls: [[3, 0, 3, 4]]");

  const Subgoal subgoal = room.step({1.0, 2.0});

  EXPECT_EQ(subgoal.place, core::Vec2(5.0, 2.0));
  EXPECT_EQ(subgoal.radius_m, 0.1);
}

TEST(NeuralMapPlanner, DoesNotTakeMovingObstaclesForStandingOnes) {
  Room room("moving: [{circle: [3, 2, 0.3], path: [[0, 3, 2], [10, 3, 3]]}]");

  const Subgoal subgoal = room.step({1.0, 2.0});

  EXPECT_NEAR(subgoal.place.y(), 2.0, 0.05);
}

TEST(NeuralMapPlanner, DrawsTheWholeLandscapeBrightestAtTheTarget) {
  Room room("walls: [[3, 0, 3, 3]]");

  const auto landscape = room.draw({1.0, 2.0}, "activation of the map");

  // 120 x 80 neurons of 0.05 m: blocks of two on each side.
  ASSERT_TRUE(landscape.has_value());
  const auto middle_of = [](const domain::PictureCell& cell) {
    return core::Vec2(0.5 * (cell.corners_odom[0] + cell.corners_odom[2]));
  };
  const auto& cells = landscape->cells;
  ASSERT_GT(cells.size(), 1500u);
  ASSERT_LE(cells.size(), 60u * 40u);
  const auto [least, most] = std::minmax_element(
      cells.begin(), cells.end(),
      [](const domain::PictureCell& a, const domain::PictureCell& b) { return a.value < b.value; });
  EXPECT_EQ(least->value, 0.0);
  EXPECT_EQ(most->value, 1.0);
  EXPECT_LT(core::length(middle_of(*most) - core::Vec2(5.0, 2.0)), 0.2);
  // The way to the corner behind the wall is the longest.
  EXPECT_LT(middle_of(*least).x(), 3.0);
  EXPECT_LT(middle_of(*least).y(), 1.0);
  for (const domain::PictureCell& cell : cells) {
    EXPECT_NEAR(core::length(cell.corners_odom[0] - cell.corners_odom[2]), 0.1 * std::sqrt(2.0),
                1e-9);
    // No neuron is active where the robot does not fit: the wall and 0.15 m beside it.
    const core::Vec2 middle = middle_of(cell);
    EXPECT_FALSE(middle.y() < 2.9 && std::fabs(middle.x() - 3.0) < 0.06) << middle.transpose();
  }
}

TEST(NeuralMapPlanner, DrawsNoLandscapeWhereNothingIsActive) {
  Room room("walls: [[3, 0, 3, 4]]");
  const auto landscape = room.draw({1.0, 2.0}, "activation of the map");
  // Only the target's side is.
  ASSERT_TRUE(landscape.has_value());
  for (const domain::PictureCell& cell : landscape->cells) {
    EXPECT_GT(cell.corners_odom[1].x(), 3.0);
  }
}

TEST(NeuralMapPlanner, GoesOnFromASavedState) {
  Room room(kWall);
  const core::Vec2 subgoal = room.step({1.0, 2.0}).place;
  core::StateWriter writer;
  room.planner().save(writer);
  const auto restored = room.make_planner();
  core::StateReader reader(writer.bytes());
  restored->load(reader);
  ASSERT_TRUE(reader.complete());

  EXPECT_EQ(room.step({1.1, 2.0}, *restored).place, subgoal);
  EXPECT_EQ(room.step(subgoal, *restored).place, room.step(subgoal).place);
}

TEST(NeuralMapPlanner, RefusesAGainThatIsNotStable) {
  NeuralMapPlanner::Parameters parameters;
  parameters.gain = 0.2;

  const auto planner = NeuralMapPlanner::create(parameters, {});

  ASSERT_FALSE(planner.ok());
  EXPECT_EQ(planner.error().message.substr(0, 33), "plan.neural_map: gain is 0.200000");
}

}  // namespace
}  // namespace clew::plan
