// SPDX-License-Identifier: Apache-2.0
#include "control/control_component.hpp"

#include <gtest/gtest.h>

namespace clew::control {
namespace {

using domain::CommandKind;
using domain::Topic;

/// Steps ahead by a tenth of the middle reading, and notes what it was asked.
class Recorder final : public Controller {
 public:
  domain::Motion step(const domain::Odometry&, const domain::Scan& scan,
                      const core::Vec2& target_odom) override {
    ++calls;
    target = target_odom;
    domain::Motion motion;
    motion.kind = CommandKind::kTurnAndStep;
    motion.step_m = 0.1 * scan.ranges_m[3];
    return motion;
  }
  void save(core::StateWriter& writer) const override { writer(calls); }
  void load(core::StateReader& reader) override { reader(calls); }

  int calls = 0;
  core::Vec2 target = core::Vec2::Zero();
};

/// Turns in place of any motion ahead while something is recognised.
class Shy final : public Reaction {
 public:
  std::optional<domain::Motion> react(const domain::Odometry&, const domain::Scan&,
                                      const domain::Landmark& landmark,
                                      const domain::Motion& wanted) override {
    if (landmark.recognitions.empty() || wanted.step_m == 0.0) return std::nullopt;
    domain::Motion motion;
    motion.kind = CommandKind::kTurnAndStep;
    motion.turn_rad = 0.5;
    return motion;
  }
  void save(core::StateWriter& writer) const override { writer(true); }
  void load(core::StateReader& reader) override {
    bool shy = false;
    reader(shy);
    reader.check(shy, "it is not shy");
  }
};

class ControlComponentTest : public ::testing::Test {
 protected:
  ControlComponentTest() {
    make({});
    auto& scan = std::get<domain::Scan>(messages_);
    scan.bearing_first_rad = core::radians(45.0);
    scan.bearing_step_rad = core::radians(-15.0);
    scan.beam_width_rad = core::radians(15.0);
    scan.range_max_m = 1.5;
    scan.ranges_m.assign(7, 1.5);
    guidance().target_x_m = 3.0;
    std::get<domain::Target>(messages_).x_m = 7.0;
    for (const Topic topic : {Topic::kOdometry, Topic::kScan, Topic::kGuidance, Topic::kTarget}) {
      inputs_.set(index_of(topic));
    }
    command_.set(index_of(Topic::kCommand));
  }

  void make(std::vector<ControlComponent::NamedReaction> reactions) {
    auto controller = std::make_unique<Recorder>();
    controller_ = controller.get();
    component_ = std::make_unique<ControlComponent>(std::move(controller), ControlParameters{},
                                                    runtime::RunSetup{}, std::move(reactions));
  }
  void make_shy() {
    std::vector<ControlComponent::NamedReaction> reactions;
    reactions.push_back({"shy", std::make_unique<Shy>()});
    make(std::move(reactions));
    inputs_.set(index_of(Topic::kLandmark));
    std::get<domain::Landmark>(messages_).recognitions.push_back({});
  }

  domain::Guidance& guidance() { return std::get<domain::Guidance>(messages_); }

  domain::Motion step(bool guided = true) {
    runtime::TopicSet present = inputs_;
    present.set(index_of(Topic::kGuidance), guided);
    present.set(index_of(Topic::kTarget), !guided);
    std::get<domain::Command>(messages_) = {};
    runtime::TickOutputs outputs(messages_, command_);
    component_->step({messages_, inputs_, present, 0}, outputs);
    return std::get<domain::Command>(messages_).motion;
  }

  Recorder* controller_ = nullptr;
  std::unique_ptr<ControlComponent> component_;
  domain::Messages messages_;
  runtime::TopicSet inputs_;
  runtime::TopicSet command_;
};

TEST_F(ControlComponentTest, SeeksTheTargetInForce) {
  step();

  EXPECT_EQ(controller_->target, core::Vec2(3, 0));
}

TEST_F(ControlComponentTest, SeeksTheMissionsTargetWithoutRecovery) {
  step(false);

  EXPECT_EQ(controller_->target, core::Vec2(7, 0));
}

TEST_F(ControlComponentTest, ShowsVirtualObstaclesToTheController) {
  guidance().virtual_obstacles.push_back({0.65, -1, 2, 1});

  // 0.65 m less the radius: a reading of 0.5 m, a tenth of it as step.
  EXPECT_NEAR(step().step_m, 0.05, 1e-12);
}

TEST_F(ControlComponentTest, PassesAnOverrideOn) {
  guidance().has_override = true;
  guidance().override_motion.kind = CommandKind::kTurnAndStep;
  guidance().override_motion.turn_rad = 1.0;

  const domain::Motion motion = step();

  EXPECT_EQ(motion.turn_rad, 1.0);
  EXPECT_EQ(controller_->calls, 0);
}

TEST_F(ControlComponentTest, GuardsAnOverrideToo) {
  std::get<domain::Scan>(messages_).ranges_m[3] = 0.12;
  guidance().has_override = true;
  guidance().override_motion.kind = CommandKind::kTurnAndStep;
  guidance().override_motion.step_m = 0.15;

  // 0.27 m from the centre, less radius and margin of 0.2 m.
  EXPECT_NEAR(step().step_m, 0.07, 1e-12);
}

TEST_F(ControlComponentTest, RecoveryThatLeadsToAPlaceIsLetThroughWithLessRoom) {
  std::get<domain::Scan>(messages_).ranges_m[3] = 0.04;  // the margin is 0.05 m
  guidance().has_override = true;
  guidance().override_motion.kind = CommandKind::kTurnAndStep;
  guidance().override_motion.step_m = 0.15;

  EXPECT_EQ(step().step_m, 0.0);
  guidance().target_is_virtual = true;
  EXPECT_NEAR(step().step_m, 0.03, 1e-12);  // with 0.01 m
}

TEST_F(ControlComponentTest, AReactionTakesThePlaceOfTheController) {
  make_shy();

  const domain::Motion motion = step();

  EXPECT_EQ(controller_->calls, 1);
  EXPECT_EQ(motion.turn_rad, 0.5);
  EXPECT_EQ(motion.step_m, 0.0);
}

TEST_F(ControlComponentTest, AReactionTakesThePlaceOfAnOverrideToo) {
  make_shy();
  guidance().has_override = true;
  guidance().override_motion.kind = CommandKind::kTurnAndStep;
  guidance().override_motion.step_m = 0.1;

  EXPECT_EQ(step().turn_rad, 0.5);
}

TEST_F(ControlComponentTest, AReactionTakesThePlaceOfTheFinalApproach) {
  make_shy();
  guidance().target_x_m = 1.0;

  EXPECT_EQ(step().turn_rad, 0.5);
  EXPECT_EQ(controller_->calls, 0);
}

TEST_F(ControlComponentTest, TheTurnToTheMissionsHeadingTakesThePlaceOfTheController) {
  guidance().target_x_m = 0.1;
  guidance().target_radius_m = 0.3;
  guidance().target_has_heading = true;
  guidance().target_heading_rad = 1.0;
  guidance().target_heading_tolerance_rad = 0.1;

  const domain::Motion motion = step();

  EXPECT_EQ(motion.turn_rad, 1.0);
  EXPECT_EQ(motion.step_m, 0.0);
  EXPECT_EQ(controller_->calls, 0);
}

TEST_F(ControlComponentTest, TheFinalApproachTakesThePlaceOfTheControllerUntilTheGuardHoldsIt) {
  guidance().target_x_m = 1.0;
  EXPECT_GT(step().step_m, 0.0);
  EXPECT_EQ(controller_->calls, 0);

  // The robot touches something ahead that its sensor does not see.
  std::get<domain::Odometry>(messages_).contact_bearings_rad.push_back(0.0);
  EXPECT_EQ(step().step_m, 0.0);
  EXPECT_EQ(controller_->calls, 1);

  // The controller steers on here, though nothing is felt any more.
  std::get<domain::Odometry>(messages_).contact_bearings_rad.clear();
  std::get<domain::Odometry>(messages_).travel_m = 0.01;
  step();
  EXPECT_EQ(controller_->calls, 2);
}

TEST_F(ControlComponentTest, WhatAReactionLetsPassIsDone) {
  make_shy();
  std::get<domain::Landmark>(messages_).recognitions.clear();

  EXPECT_EQ(step().turn_rad, 0.0);
  EXPECT_GT(step().step_m, 0.0);
}

TEST_F(ControlComponentTest, GivesUpWhatIsUnreachable) {
  guidance().mode = domain::GuidanceMode::kUnreachable;

  EXPECT_EQ(step().kind, CommandKind::kGiveUp);
  EXPECT_EQ(controller_->calls, 0);
}

TEST_F(ControlComponentTest, SavesGuardApproachControllerAndReactions) {
  make_shy();
  step();
  core::StateWriter first;
  component_->save(first);
  make_shy();
  core::StateReader reader(first.bytes());
  component_->load(reader);

  EXPECT_TRUE(reader.complete());
  EXPECT_EQ(controller_->calls, 1);
  core::StateWriter second;
  component_->save(second);
  EXPECT_EQ(second.bytes(), first.bytes());
}

TEST_F(ControlComponentTest, RefusesAStateInWhichTheGuardTurnsToNoSide) {
  core::StateWriter writer;
  component_->save(writer);
  std::string bytes(writer.bytes());
  bytes[0] = 2;  // the guard's state begins with the side
  core::StateReader reader(bytes);
  component_->load(reader);

  EXPECT_FALSE(reader.ok());
}

}  // namespace
}  // namespace clew::control
