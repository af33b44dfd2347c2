// SPDX-License-Identifier: Apache-2.0
/// The stage as a graph has it: made of names and parameters.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "control/stage.hpp"
#include "core/angle.hpp"
#include "domain/messages.hpp"

namespace clew::control {
namespace {

using domain::Topic;

runtime::StageConfig config_of(const core::ParameterValues& changed,
                               const core::ParameterValues& of_controller = {}) {
  runtime::StageConfig config;
  config.stage = "control";
  config.parameters = core::default_values(stage().parameters);
  for (const auto& [name, value] : changed) config.parameters.at(name) = value;
  const std::string controller = "regulated_pure_pursuit";
  const runtime::VariantInfo* variant = stage().parts.at(0).find(controller);
  EXPECT_NE(variant, nullptr);
  runtime::PartChoice choice{controller, core::default_values(variant->parameters)};
  for (const auto& [name, value] : of_controller) choice.parameters.at(name) = value;
  config.parts["behaviour"] = {choice};
  config.parts["reaction"] = {};
  return config;
}

/// What is left of a step of 0.15 m that recovery asks for, with a return 0.12 m ahead.
double step_m(const core::ParameterValues& changed) {
  auto component = stage().make(config_of(changed), {});
  if (!component.ok()) {
    ADD_FAILURE() << component.error().text();
    return 0.0;
  }
  domain::Messages messages;
  auto& scan = std::get<domain::Scan>(messages);
  scan.bearing_first_rad = core::radians(45.0);
  scan.bearing_step_rad = core::radians(-15.0);
  scan.beam_width_rad = core::radians(15.0);
  scan.range_max_m = 1.5;
  scan.ranges_m.assign(7, 1.5);
  scan.ranges_m[3] = 0.12;
  auto& guidance = std::get<domain::Guidance>(messages);
  guidance.has_override = true;
  guidance.override_motion.kind = domain::CommandKind::kTurnAndStep;
  guidance.override_motion.step_m = 0.15;
  runtime::TopicSet inputs;
  for (const Topic topic : {Topic::kOdometry, Topic::kScan, Topic::kGuidance}) {
    inputs.set(index_of(topic));
  }
  runtime::TopicSet command;
  command.set(index_of(Topic::kCommand));
  runtime::TickOutputs outputs(messages, command);
  (*component)->step({messages, inputs, inputs, 0}, outputs);
  return std::get<domain::Command>(messages).motion.step_m;
}

TEST(ControlStage, HandsTheGuardItsParameters) {
  // 0.12 m less the margin, or all of it.
  EXPECT_NEAR(step_m({}), 0.07, 1e-12);
  EXPECT_NEAR(step_m({{"guard_margin_m", 0.1}}), 0.02, 1e-12);
  EXPECT_EQ(step_m({{"guard", false}}), 0.15);
}

TEST(ControlStage, AsksForNoTickAndSaysWhatItReadsAndWrites) {
  EXPECT_EQ(stage().tick_s(config_of({})), 0.0);
  EXPECT_FALSE(stage().knows_world);
  std::string ports;
  for (const runtime::PortInfo& port : stage().ports) {
    ports += std::string(domain::topic_name(port.topic)) +
             (port.direction == runtime::PortInfo::Direction::kOutput ? "! " : " ");
  }
  EXPECT_EQ(ports, "odometry scan guidance target landmark command! ");
}

TEST(ControlStage, PassesOnWhatAControllerRefuses) {
  const auto config = config_of({}, {{"speed_mps", 0.1}, {"least_speed_mps", 0.2}});

  const auto made = stage().make(config, {});

  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.error().text(),
            "control.regulated_pure_pursuit: least_speed_mps must not be greater than speed_mps");
}

}  // namespace
}  // namespace clew::control
