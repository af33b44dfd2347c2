// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

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
    runtime::TopicSet odometry;
    odometry.set(static_cast<std::size_t>(Topic::kOdometry));
    runtime::Node node("plan", runtime::resolve_ports(stage(), odometry),
                       stage().make(config_, setup_).value(), 0.3);
    domain::Messages messages;
    std::get<domain::Odometry>(messages).pose_odom_robot = {1.0, 5.0, 0.0};
    node.step(0, odometry, messages);
    return std::get<domain::Target>(messages);
  }

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

TEST_F(PlanStage, RefusesAMapThatIsNotNamedOrBroken) {
  config_.parameters["map"] = std::string("file");
  EXPECT_EQ(error(), "plan.map is file, and plan.map_file names none");

  config_.parameters["map_file"] = std::string("hall");
  setup_.behaviour.resources.add("maps", "hall", {"hall.yaml", "image: [1]\n", ""});
  EXPECT_EQ(error(), "hall.yaml:1:1: missing key 'resolution'");
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
