// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "drive/drive_component.hpp"
#include "drive/turn_then_step.hpp"

namespace clew::drive {

using domain::CommandKind;
using domain::Motion;
using domain::Topic;

/// A drive alone, fed with commands.
class DriveRun {
 public:
  explicit DriveRun(const std::string& obstacles = "", bool safety = true,
                    std::uint64_t max_ticks = 100, const DriftParameters& drift = {},
                    const ArrivalParameters& arrival = {},
                    const std::optional<world::Goals>& goals = std::nullopt,
                    const ActuatorParameters& actuators = {}) {
    auto world = world::World::parse("format: clew-world/1\nname: test\nbounds: [0, 0, 20, 20]\n" +
                                         obstacles +
                                         "\nstart: [5, 5, 0]\ntarget: [6, 5]\ntarget_radius: 0.2\n",
                                     "test.yaml", goals);
    EXPECT_TRUE(world.ok()) << world.error().text();
    runtime::RunSetup setup;
    setup.world = std::make_shared<const world::World>(std::move(world).value());
    setup.max_ticks = max_ticks;
    component_.emplace(std::make_unique<TurnThenStep>(TurnThenStepParameters{}, 0.3),
                       SafetyParameters{safety, 0.005}, drift, actuators, arrival, setup);
    command_.set(index_of(Topic::kCommand));
    for (const Topic topic : {Topic::kState, Topic::kOdometry, Topic::kTarget}) {
      outputs_.set(index_of(topic));
    }
  }

  /// The first tick, without a command.
  const domain::State& start() { return step({}, false); }
  /// The next tick, after `motion`; `present` tells whether the command came.
  const domain::State& step(const Motion& motion, bool present = true) {
    std::get<domain::Command>(messages_).motion = motion;
    runtime::TickOutputs outputs(messages_, outputs_);
    std::get<domain::State>(messages_) = {};
    std::get<domain::Odometry>(messages_) = {};
    component_->step({messages_, command_, present ? command_ : runtime::TopicSet(), tick_++},
                     outputs);
    return std::get<domain::State>(messages_);
  }
  /// Takes over the state of another one.
  void go_on_from(const DriveRun& other) {
    core::StateWriter writer;
    other.component_->save(writer);
    const std::string state = writer.take();
    core::StateReader reader(state);
    component_->load(reader);
    EXPECT_TRUE(reader.complete()) << reader.fault();
    tick_ = other.tick_;
  }
  std::string saved() const {
    core::StateWriter writer;
    component_->save(writer);
    return writer.take();
  }
  /// What is wrong with a state that it is to go on from.
  std::string fault_of(const std::string& state) {
    core::StateReader reader(state);
    component_->load(reader);
    return reader.complete() ? "" : reader.fault();
  }
  const domain::Messages& messages() const { return messages_; }
  /// What is told of the tick before.
  std::string told(bool command_came) const {
    const runtime::TopicSet known = command_came ? outputs_ | command_ : outputs_;
    domain::Inside inside;
    component_->tell({messages_, outputs_ | command_, known, tick_ - 1}, inside);
    return inside.text;
  }

 private:
  std::optional<DriveComponent> component_;
  domain::Messages messages_;
  runtime::TopicSet command_;
  runtime::TopicSet outputs_;
  std::uint64_t tick_ = 0;
};

inline Motion ahead(double step_m) {
  Motion motion;
  motion.kind = CommandKind::kTurnAndStep;
  motion.step_m = step_m;
  return motion;
}

}  // namespace clew::drive
