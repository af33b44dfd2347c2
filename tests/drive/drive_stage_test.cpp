// SPDX-License-Identifier: Apache-2.0
/// The stage as a graph has it: each drive, made of its name and its parameters.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "core/angle.hpp"
#include "domain/messages.hpp"
#include "drive/stage.hpp"
#include "world/world.hpp"

namespace clew::drive {
namespace {

using domain::Topic;

constexpr double kDistance_m = 1.0;

const runtime::VariantInfo& variant(const std::string& name) {
  const runtime::VariantInfo* found = stage().parts.at(0).find(name);
  EXPECT_NE(found, nullptr) << name;
  return *found;
}

/// A drive with its defaults, but for `changed`; the stage's own are changed likewise.
runtime::StageConfig config_of(const std::string& drive, const core::ParameterValues& changed = {},
                               const core::ParameterValues& of_stage = {}) {
  runtime::StageConfig config;
  config.stage = "drive";
  config.parameters = core::default_values(stage().parameters);
  for (const auto& [name, value] : of_stage) config.parameters.at(name) = value;
  runtime::PartChoice choice{drive, core::default_values(variant(drive).parameters)};
  for (const auto& [name, value] : changed) choice.parameters.at(name) = value;
  config.parts["behaviour"] = {choice};
  return config;
}

/// A robot at the origin of a free plane, which looks along x, with a target ahead of it.
runtime::RunSetup setup() {
  auto world = world::World::parse(
      "format: clew-world/1\nname: test\nbounds: [-9, -9, 9, 9]\nstart: [0, 0, 0]\n"
      "target: [1, 0]\ntarget_radius: 0.05\n",
      "test.yaml");
  EXPECT_TRUE(world.ok()) << world.error().text();
  runtime::RunSetup setup;
  setup.world = std::make_shared<const world::World>(std::move(world).value());
  setup.behaviour.robot.radius_m = 0.15;
  return setup;
}

/// Where a drive brings the robot in a tick with this command.
domain::State moved(const runtime::StageConfig& config, const domain::Motion& motion) {
  auto component = stage().make(config, setup());
  EXPECT_TRUE(component.ok()) << component.error().text();
  domain::Messages messages;
  runtime::TopicSet command;
  command.set(index_of(Topic::kCommand));
  runtime::TopicSet written;
  for (const Topic topic : {Topic::kState, Topic::kOdometry, Topic::kTarget}) {
    written.set(index_of(topic));
  }
  runtime::TickOutputs outputs(messages, written);
  (*component)->step({messages, command, {}, 0}, outputs);
  std::get<domain::Command>(messages).motion = motion;
  (*component)->step({messages, command, command, 1}, outputs);
  return std::get<domain::State>(messages);
}

domain::Motion velocities(double speed_mps, double turn_rate_radps) {
  domain::Motion motion;
  motion.kind = domain::CommandKind::kVelocities;
  motion.speed_mps = speed_mps;
  motion.turn_rate_radps = turn_rate_radps;
  return motion;
}

TEST(DriveStage, KnowsTheTickOfEachDrive) {
  const std::map<std::string, double> ticks_s = {
      {"turn_then_step", 0.3}, {"unicycle", 0.1}, {"differential", 0.1}};
  ASSERT_EQ(stage().parts.at(0).variants.size(), ticks_s.size());
  for (const auto& [drive, tick_s] : ticks_s) {
    EXPECT_EQ(stage().tick_s(config_of(drive)), tick_s) << drive;
    EXPECT_EQ(stage().tick_s(config_of(drive, {{"tick_s", 0.25}})), 0.25) << drive;
  }
}

TEST(DriveStage, KnowsWhatEachDriveCanDo) {
  const auto steps = stage().motion_limits(config_of("turn_then_step", {{"max_turn_deg", 90.0}}));
  const auto unicycle = stage().motion_limits(config_of("unicycle", {{"max_speed_mps", 0.5}}));
  const auto wheels = stage().motion_limits(config_of("differential", {{"wheel_base_m", 0.5}}));

  EXPECT_NEAR(steps.speed_mps, 0.15 / 0.3, 1e-12);  // a step of 0.15 m in a tick of 0.3 s
  EXPECT_NEAR(steps.turn_rate_radps, core::radians(90.0) / 0.3, 1e-12);
  EXPECT_EQ(unicycle.speed_mps, 0.5);
  EXPECT_EQ(unicycle.acceleration_mps2, 0.5);
  EXPECT_EQ(wheels.speed_mps, 0.8);
  EXPECT_NEAR(wheels.turn_rate_radps, 2.0 * 0.8 / 0.5, 1e-12);
}

TEST(DriveStage, MakesEachDriveWithItsParameters) {
  const domain::Motion ahead = velocities(0.4, 0.0);

  // 0.4 m/s for a tick: in 0.3 s, in 0.1 s with 10 m/s^2, and in 0.1 s with wheels of 0.2 m/s.
  EXPECT_NEAR(moved(config_of("turn_then_step"), ahead).pose_world_robot.x_m, 0.12, 1e-12);
  EXPECT_NEAR(
      moved(config_of("unicycle", {{"max_acceleration_mps2", 10.0}}), ahead).pose_world_robot.x_m,
      0.04, 1e-12);
  EXPECT_NEAR(
      moved(config_of("differential", {{"max_wheel_speed_mps", 0.2}}), ahead).pose_world_robot.x_m,
      0.02, 1e-12);
}

TEST(DriveStage, HasTheRobotsDiameterForItsWheelBase) {
  domain::Motion wheels;
  wheels.kind = domain::CommandKind::kWheelSpeeds;
  wheels.left_mps = 0.2;
  wheels.right_mps = 0.3;

  // 0.1 m/s over 0.3 m, for 0.3 s.
  EXPECT_NEAR(moved(config_of("turn_then_step"), wheels).pose_world_robot.heading_rad, 0.1, 1e-12);
}

TEST(DriveStage, HandsItsOwnParametersToWhatTheyAreOf) {
  const domain::Motion ahead = velocities(0.4, 0.0);

  const auto slipping =
      moved(config_of("turn_then_step", {}, {{"slip_m_per_m", 0.5}}), ahead).pose_world_robot;
  const auto arrived = moved(config_of("turn_then_step", {}, {{"arrive_m", kDistance_m}}), ahead);

  EXPECT_NEAR(slipping.x_m, 0.06, 1e-12);
  EXPECT_EQ(arrived.outcome, domain::Outcome::kReached);
}

}  // namespace
}  // namespace clew::drive
