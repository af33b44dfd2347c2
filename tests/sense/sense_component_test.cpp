// SPDX-License-Identifier: Apache-2.0
#include "sense/sense_component.hpp"

#include <gtest/gtest.h>

#include "sense/cones.hpp"
#include "sense/stage.hpp"

namespace clew::sense {
namespace {

std::shared_ptr<const world::World> world_with_a_moving_disc() {
  auto world = world::World::parse(
      "format: clew-world/1\nname: test\nbounds: [0, 0, 20, 20]\n"
      "moving: [{circle: [11, 10, 0.2], path: [[0, 11, 10], [10, 12, 10]], loop: false}]\n"
      "start: [10, 10, 0]\ntarget: [19, 19]\ntarget_radius: 0.2\n",
      "test.yaml");
  EXPECT_TRUE(world.ok()) << world.error().text();
  return std::make_shared<const world::World>(std::move(world).value());
}

TEST(SenseComponent, MeasuresAtTheTimeOfTheState) {
  runtime::RunSetup setup;
  setup.world = world_with_a_moving_disc();
  SenseComponent component(std::make_unique<Cones>(ConesParameters{}, 0.15), setup);
  domain::Messages messages;
  auto& state = std::get<domain::State>(messages);
  state.pose_world_robot = {10, 10, 0};
  state.stamp = {15, 5.0, 15};
  runtime::TopicSet state_only;
  state_only.set(index_of(domain::Topic::kState));
  runtime::TopicSet scan_only;
  scan_only.set(index_of(domain::Topic::kScan));
  runtime::TickOutputs outputs(messages, scan_only);

  component.step({messages, state_only, state_only, 15}, outputs);

  // After 5 s the disc of 0.2 m is half way, at x = 11.5: 1.3 m from the robot's centre.
  EXPECT_NEAR(std::get<domain::Scan>(messages).ranges_m[3], 1.3 - 0.15, 1e-9);
}

TEST(SenseStage, TellsTheLayoutOfItsScansBeforeTheRun) {
  runtime::StageConfig config;
  config.stage = "sense";
  runtime::PartChoice cones{"cones",
                            core::default_values(core::describe_parameters<ConesParameters>())};
  cones.parameters["range_m"] = 2.5;
  config.parts["behaviour"] = {cones};

  const domain::ScanLayout layout = stage().scan_layout(config);

  EXPECT_EQ(layout.beam_count, 7u);
  EXPECT_EQ(layout.range_max_m, 2.5);
}

}  // namespace
}  // namespace clew::sense
