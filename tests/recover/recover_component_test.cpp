// SPDX-License-Identifier: Apache-2.0
#include "recover/recover_component.hpp"

#include <gtest/gtest.h>

#include "tests/recover/told_behaviours.hpp"

namespace clew::recover {
namespace {

using domain::EventKind;
using domain::GuidanceMode;

TEST_F(RecoverComponentTest, SeeksTheMissionsTargetWithoutATrap) {
  const domain::Guidance& guidance = step(Scene().target(4, 5));

  EXPECT_EQ(guidance.mode, GuidanceMode::kSeek);
  EXPECT_EQ(guidance.target_x_m, 4.0);
  EXPECT_EQ(guidance.target_y_m, 5.0);
  EXPECT_FALSE(guidance.has_override);
  EXPECT_TRUE(events().empty());
}

TEST_F(RecoverComponentTest, LetsEveryEscapeWatchEveryTick) {
  step();
  detector_->trap = true;
  step();

  EXPECT_EQ(first_->watched, 2);
  EXPECT_EQ(second_->watched, 2);
}

TEST_F(RecoverComponentTest, LogsATrapSeenAtAGlanceWithoutAnEarlierVisit) {
  detector_->trap = detector_->at_a_glance = true;
  step();

  EXPECT_EQ(event(0).kind, EventKind::kTrap);
  EXPECT_FALSE(event(0).has_earlier);
}

TEST_F(RecoverComponentTest, LogsAVirtualTargetWhereItIsWhenItIsSet) {
  detector_->trap = true;
  first_->virtual_target = core::Vec2(6, 7);
  step();
  const auto when_set = events();
  const auto entry = event(2);
  step();
  const auto later = events();
  first_->virtual_target = core::Vec2(8, 7);
  step();

  EXPECT_EQ(when_set, (std::vector<EventKind>{EventKind::kTrap, EventKind::kEscapeBegun,
                                              EventKind::kVirtualTarget}));
  EXPECT_EQ(entry.rule, "first");
  EXPECT_EQ(entry.x_m, 6.0);
  EXPECT_EQ(entry.y_m, 7.0);
  EXPECT_TRUE(later.empty());
  EXPECT_EQ(events(), std::vector<EventKind>{EventKind::kVirtualTarget});
}

TEST_F(RecoverComponentTest, TellsDetectorsWhichTargetIsPursued) {
  step(Scene().target(4, 5));
  EXPECT_EQ(detector_->pursued, core::Vec2(4, 5));

  detector_->trap = true;
  first_->virtual_target = core::Vec2(6, 7);
  step(Scene().target(4, 5));
  step(Scene().target(4, 5));
  EXPECT_EQ(detector_->pursued, core::Vec2(6, 7));
}

TEST_F(RecoverComponentTest, SeeksAgainWhenAnEscapeEnds) {
  detector_->trap = true;
  step();
  first_->status = EscapeStatus::kEnded;

  const domain::Guidance& guidance = step(Scene().target(4, 5));

  EXPECT_EQ(guidance.mode, GuidanceMode::kSeek);
  EXPECT_FALSE(guidance.has_override);
  EXPECT_EQ(guidance.target_x_m, 4.0);
  EXPECT_EQ(events(), std::vector<EventKind>{EventKind::kEscapeEnded});
  EXPECT_EQ(detector_->ends, 1);
  EXPECT_EQ(shadow_->ends, 1);
}

TEST_F(RecoverComponentTest, ForgetsTheGoalBeforeWhileTheRobotWaits) {
  detector_->trap = true;
  step();
  first_->status = EscapeStatus::kUnreachable;
  const auto gave_up = step().mode;
  const int observed = detector_->observed;

  const auto while_waiting = step(Scene().target(0, 0)).mode;
  const int observed_waiting = detector_->observed;
  detector_->trap = false;
  const auto with_a_new_goal = step(Scene().target(4, 5)).mode;

  EXPECT_EQ(gave_up, GuidanceMode::kUnreachable);
  EXPECT_EQ(while_waiting, GuidanceMode::kSeek);
  EXPECT_EQ(observed_waiting, observed);
  EXPECT_EQ(with_a_new_goal, GuidanceMode::kSeek);
}

// Else nothing would lead out of a trap that it drifts into: control steers by then.
TEST_F(RecoverComponentTest, WaitsNoMoreOnceTheHeadingWasMetUntilTheRobotWasOutside) {
  heading_rad_ = 0.0;
  const auto observes = [&](const Scene& scene) {
    const int before = detector_->observed;
    step(scene);
    return detector_->observed > before;
  };
  const Scene turned = Scene().at(4, 5, 60).target(4, 5);

  EXPECT_FALSE(observes(turned));
  EXPECT_TRUE(observes(Scene().at(4, 5, 3).target(4, 5)));
  EXPECT_TRUE(observes(turned));  // it has met the heading
  EXPECT_TRUE(observes(Scene().at(4.5, 5, 60).target(4, 5)));
  EXPECT_FALSE(observes(turned));  // it comes anew
  EXPECT_TRUE(observes(Scene().at(4, 5, 3).target(4, 5)));
  EXPECT_FALSE(observes(Scene().at(4, 5, 60).target(4.1, 5)));  // another target
}

TEST_F(RecoverComponentTest, StartsDetectorsAfreshAtAWaypoint) {
  step();
  step();
  EXPECT_EQ(detector_->ends, 0);

  waypoint_ = 2;
  step();
  EXPECT_EQ(detector_->ends, 1);
  EXPECT_EQ(shadow_->ends, 1);

  step();
  EXPECT_EQ(detector_->ends, 1);
}

TEST_F(RecoverComponentTest, DoesNotTakeAPlansSubgoalForAWaypoint) {
  step(Scene().at(0, 0, 0).target(1, 0));
  step(Scene().at(1, 0, 0).target(5, 5));

  EXPECT_EQ(detector_->ends, 0);
}

TEST_F(RecoverComponentTest, LogsAShadowAndDoesNothingElse) {
  shadow_->trap = true;

  const domain::Guidance& guidance = step();

  EXPECT_EQ(guidance.mode, GuidanceMode::kSeek);
  ASSERT_EQ(events(), std::vector<EventKind>{EventKind::kTrap});
  EXPECT_TRUE(event(0).shadow);
  EXPECT_EQ(event(0).rule, "watcher");
  EXPECT_EQ(first_->begins, 0);
}

TEST_F(RecoverComponentTest, LogsLandmarks) {
  step(Scene().recognises(domain::Network::kFuzzyArt, 4, {7, 8, 1}));

  ASSERT_EQ(events(), std::vector<EventKind>{EventKind::kLandmark});
  EXPECT_EQ(event(0).rule, "fuzzy_art");
  EXPECT_EQ(event(0).text, "[7 8 1]");
  EXPECT_EQ(event(0).cell, 4u);
}

TEST_F(RecoverComponentTest, FiresTheImmediateMemory) {
  const domain::Guidance& guidance = step(Scene().recognises(domain::Network::kSom, 4, {7, 1, 0}));

  EXPECT_TRUE(guidance.has_override);
  EXPECT_EQ(guidance.override_motion.turn_rad, core::radians(-90.0));
  EXPECT_EQ(guidance.mode, GuidanceMode::kSeek);
  EXPECT_EQ(events(), (std::vector<EventKind>{EventKind::kLandmark, EventKind::kReflex}));
}

TEST_F(RecoverComponentTest, PutsAnEscapesMotionBeforeTheImmediateMemory) {
  detector_->trap = true;

  EXPECT_EQ(step(Scene().recognises(domain::Network::kSom, 4, {7, 1, 0})).override_motion.turn_rad,
            0.1);
}

TEST_F(RecoverComponentTest, GoesOnAsBeforeAfterSaveAndLoad) {
  detector_->trap = true;
  step();
  first_->status = EscapeStatus::kFailed;
  step();
  core::StateWriter writer;
  component_->save(writer);

  make_component();
  core::StateReader reader(writer.bytes());
  component_->load(reader);

  EXPECT_TRUE(reader.complete());
  EXPECT_EQ(step().override_motion.turn_rad, 0.2);
}

}  // namespace
}  // namespace clew::recover
