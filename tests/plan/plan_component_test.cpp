// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/angle.hpp"
#include "core/math.hpp"
#include "plan/known_map.hpp"
#include "plan/stage.hpp"
#include "runtime/node.hpp"
#include "world/world.hpp"

namespace clew::plan {
namespace {

using domain::Topic;

constexpr char kMapHead[] =
    "image: hall.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
    "free_thresh: 0.196\n";

/// The stage as a graph file would configure it, in an open hall of 10 m x 10 m.
class PlanStage : public ::testing::Test {
 protected:
  PlanStage() {
    auto world = world::World::parse(
        "format: clew-world/1\nname: hall\nbounds: [0, 0, 10, 10]\nstart: [1, 5, 0]\n"
        "target: [9, 5]\ntarget_radius: 0.2\n",
        "hall.yaml");
    setup_.world = std::make_shared<const world::World>(std::move(world).value());
    config_.stage = "plan";
    config_.parameters = core::default_values(stage().parameters);
    const auto& variant = stage().parts.front().variants.front();
    config_.parts["behaviour"] = {{variant.name, core::default_values(variant.parameters)}};
  }
  std::string error() const {
    const auto made = stage().make(config_, setup_);
    return made.ok() ? "no error" : made.error().text();
  }
  domain::Target target_of_tick_0() const {
    runtime::TopicSet inputs;
    inputs.set(index_of(Topic::kOdometry));
    inputs.set(index_of(Topic::kScan));
    runtime::Node node("plan", runtime::resolve_ports(stage(), inputs),
                       stage().make(config_, setup_).value(), 0.3);
    domain::Messages messages;
    std::get<domain::Odometry>(messages).pose_odom_robot = {1.0, 5.0, 0.0};
    std::get<domain::Scan>(messages) = scan_;
    node.step(0, inputs, messages);
    return std::get<domain::Target>(messages);
  }

  domain::Scan scan_;
  runtime::RunSetup setup_;
  runtime::StageConfig config_;
};

TEST_F(PlanStage, WritesASubgoalOnTheWayToTheTarget) {
  const domain::Target target = target_of_tick_0();

  EXPECT_NEAR(target.x_m, 4.0, 0.1);  // 3 m ahead
  EXPECT_NEAR(target.y_m, 5.0, 0.1);
  EXPECT_EQ(target.radius_m, 0.3);
}

TEST_F(PlanStage, GoesByTheMapOfAFile) {
  // 20 x 20 cells of 0.5 m with a wall across all rows but the two at the top.
  std::string image = "P2 20 20 255\n";
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 20; ++column) {
      image += column == 6 && row >= 2 ? "0 " : "255 ";
    }
  }
  setup_.behaviour.resources.add("maps", "hall", {"hall.yaml", kMapHead, image});
  config_.parameters["map"] = std::string("file");
  config_.parameters["map_file"] = std::string("hall");

  const domain::Target target = target_of_tick_0();

  // Up toward the gap, where the world's own straight way would be at y = 5.
  EXPECT_GT(target.y_m, 6.5);
  EXPECT_LT(target.x_m, 3.0);
}

TEST_F(PlanStage, GoesByWhatTheRobotHasSeen) {
  config_.parameters["map"] = std::string("seen");
  // Rays a degree apart over half a circle, that end on a wall of 2 m across the way, 1 m from the
  // skin of the robot, and reach 4 m elsewhere.
  constexpr int kRays = 181;
  scan_.range_max_m = 4.0;
  scan_.bearing_first_rad = core::radians(90.0);
  scan_.bearing_step_rad = core::radians(-1.0);
  for (int i = 0; i < kRays; ++i) {
    const double bearing_rad = core::radians(90.0 - i);
    const double to_wall_m = 1.15 / std::max(1e-3, core::cos(bearing_rad));
    const bool meets = to_wall_m * std::fabs(core::sin(bearing_rad)) <= 1.0;
    scan_.ranges_m.push_back(meets ? to_wall_m - 0.15 : 4.0);
  }

  const domain::Target target = target_of_tick_0();

  // Round the wall's end, which is at x = 2.15 m and 1 m to the side.
  EXPECT_GT(std::fabs(target.y_m - 5.0), 1.15);
  EXPECT_LT(target.x_m, 4.0);
}

TEST_F(PlanStage, LeadsToTheNextWaypointAndOnlyThenAlongTheSubgoals) {
  const std::string world =
      "format: clew-world/1\nname: hall\nbounds: [0, 0, 10, 10]\nstart: [1, 5, 0]\n"
      "subgoals: [[6, 8]]\ntarget: [9, 5]\ntarget_radius: 0.2\nwaypoints: ";
  config_.parts["behaviour"] = {{"world_subgoals", {{"close_m", 0.2}}}};
  const auto target_with = [&](const std::string& waypoints) {
    auto parsed = world::World::parse(world + waypoints, "hall.yaml");
    setup_.world = std::make_shared<const world::World>(std::move(parsed).value());
    return target_of_tick_0();
  };

  // The robot stands at [1, 5].
  EXPECT_EQ(target_with("[[1, 5.1], [3, 2, 0.5]]").position(), core::Vec2(3.0, 2.0));
  EXPECT_EQ(target_with("[[1, 5.1], [3, 2, 0.5]]").radius_m, 0.5);
  EXPECT_EQ(target_with("[[1, 5.1], [1.2, 5]]").position(), core::Vec2(6.0, 8.0));
}

TEST_F(PlanStage, StaysWhereItIsWithoutAMission) {
  auto world = world::World::parse(
      "format: clew-world/1\nname: hall\nbounds: [0, 0, 10, 10]\nstart: [1, 5, 0]\n"
      "target: [9, 5]\ntarget_radius: 0.2\n",
      "hall.yaml", world::Goals{});
  setup_.world = std::make_shared<const world::World>(std::move(world).value());

  EXPECT_EQ(target_of_tick_0().position(), core::Vec2(1.0, 5.0));
}

TEST_F(PlanStage, LeadsAlongTheSubgoalsOfTheWorld) {
  auto world = world::World::parse(
      "format: clew-world/1\nname: hall\nbounds: [0, 0, 10, 10]\nstart: [1, 5, 0]\n"
      "subgoals: [[1, 5.1], [3, 8], [6, 8]]\ntarget: [9, 5]\ntarget_radius: 0.2\n",
      "hall.yaml");
  setup_.world = std::make_shared<const world::World>(std::move(world).value());
  config_.parts["behaviour"] = {{"world_subgoals", {{"close_m", 0.2}}}};

  const domain::Target target = target_of_tick_0();

  // The first lies within close_m of the start.
  EXPECT_EQ(target.position(), core::Vec2(3.0, 8.0));
  EXPECT_EQ(target.radius_m, 0.2);
}

TEST_F(PlanStage, RefusesAMapThatIsNotNamedOrBroken) {
  config_.parameters["map"] = std::string("file");
  EXPECT_EQ(error(), "plan.map is file, and plan.map_file names none");

  config_.parameters["map_file"] = std::string("hall");
  setup_.behaviour.resources.add("maps", "hall", {"hall.yaml", "image: [1]\n", ""});
  EXPECT_EQ(error(), "hall.yaml:1:1: missing key 'resolution'");
}

TEST_F(PlanStage, RefusesAMapThatDoesNotHoldBothEndsOfTheMission) {
  config_.parameters["map"] = std::string("file");
  config_.parameters["map_file"] = std::string("hall");
  const auto error_with_origin = [&](const std::string& origin) {
    setup_.behaviour.resources = {};
    setup_.behaviour.resources.add("maps", "hall",
                                   {"hall.yaml",
                                    "image: hall.pgm\nresolution: 5\norigin: " + origin +
                                        "\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
                                    "P2 2 2 255 255 255 255 255"});
    return error();
  };

  // The start is at (1, 5), the target at (9, 5).
  EXPECT_EQ(error_with_origin("[2, 0, 0]"),
            "hall.yaml: the map covers x from 2 to 12 m and y from 0 to 10 m, and the start is at "
            "(1, 5): outside");
  EXPECT_EQ(error_with_origin("[-2, 0, 0]"),
            "hall.yaml: the map covers x from -2 to 8 m and y from 0 to 10 m, and the target is at "
            "(9, 5): outside");
  EXPECT_EQ(error_with_origin("[0, 0, 0]"), "no error");
}

TEST_F(PlanStage, RefusesCellsThatAreTooMany) {
  auto world = world::World::parse(
      "format: clew-world/1\nname: plain\nbounds: [0, 0, 1000, 1000]\nstart: [1, 5, 0]\n"
      "target: [9, 5]\ntarget_radius: 0.2\n",
      "plain.yaml");
  setup_.world = std::make_shared<const world::World>(std::move(world).value());

  // 20,000 x 20,000; 4096 x 4096 are allowed.
  EXPECT_EQ(error(),
            "plan.cell_m 0.05 m makes 400000000 cells of a world of 1000 m x 1000 m; allowed: at "
            "most 16777216, as with 0.25 m");
}

}  // namespace
}  // namespace clew::plan
