// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "recover/recover_component.hpp"
#include "tests/recover/told_behaviours.hpp"

namespace clew::recover {
namespace {

using domain::EventKind;
using domain::GuidanceMode;

using OrderOfEscapes = RecoverComponentTest;

TEST_F(OrderOfEscapes, StartsTheFirstEscapeInTheTickOfTheTrap) {
  detector_->trap = true;

  const domain::Guidance& guidance = step(Scene().at(2, 3, 0));

  EXPECT_EQ(guidance.mode, GuidanceMode::kRecover);
  EXPECT_EQ(guidance.override_motion.turn_rad, 0.1);
  EXPECT_EQ(first_->reason, "told so");
  ASSERT_EQ(events(), (std::vector<EventKind>{EventKind::kTrap, EventKind::kEscapeBegun}));
  EXPECT_EQ(event(0).rule, "told");
  EXPECT_EQ(event(0).x_m, 2.0);
  EXPECT_TRUE(event(0).has_earlier);
  EXPECT_EQ(event(0).earlier_tick, 3u);
  EXPECT_EQ(event(0).earlier_y_m, 2.0);
  EXPECT_EQ(event(0).travel_m, 9.0);
  EXPECT_EQ(event(0).cell, 7u);
  EXPECT_EQ(event(1).rule, "first");
}

TEST_F(OrderOfEscapes, ShowsAllBehavioursTheSameSurroundings) {
  step();
  EXPECT_EQ(first_->local_map, nullptr);  // nobody has asked for them

  make_component(map::LocalMap({}, 0.15));
  step(Scene().at(2, 3, 0));

  ASSERT_NE(first_->local_map, nullptr);
  EXPECT_EQ(second_->local_map, first_->local_map);
  EXPECT_TRUE(first_->local_map->seen().is(map::Mark::kFree, {2, 3}));  // where it stands
}

TEST_F(OrderOfEscapes, ForgetsItsSurroundingsWhenTheEscapeLooksAgain) {
  make_component(map::LocalMap({}, 0.15));
  detector_->trap = true;
  first_->status = EscapeStatus::kLooksAgain;

  const domain::Guidance& guidance = step();

  EXPECT_EQ(guidance.mode, GuidanceMode::kRecover);  // the escape goes on
  EXPECT_TRUE(first_->local_map->seen().state().tiles.empty());
}

TEST_F(OrderOfEscapes, BeginsALateMapWithTheFirstEscapeThatReadsIt) {
  make_component(map::LocalMap({}, 0.15), true);
  second_->reads_map = true;
  detector_->trap = true;
  step(Scene().at(2, 3, 0));
  first_->status = EscapeStatus::kFailed;
  step(Scene().at(2, 3, 0));
  const bool mapped_before = !first_->local_map->seen().state().tiles.empty();
  step(Scene().at(5, 3, 0));

  EXPECT_FALSE(mapped_before);
  EXPECT_TRUE(second_->local_map->seen().is(map::Mark::kFree, {5, 3}));
}

TEST_F(OrderOfEscapes, SavesItsSurroundingsOnce) {
  make_component(map::LocalMap({}, 0.15));
  step(Scene().at(2, 3, 0));
  core::StateWriter writer;
  component_->save(writer);
  make_component(map::LocalMap({}, 0.15));

  core::StateReader reader(writer.bytes());
  component_->load(reader);

  EXPECT_TRUE(reader.complete());
  step(Scene().at(5, 3, 0));
  EXPECT_TRUE(first_->local_map->seen().is(map::Mark::kFree, {2, 3}));
}

TEST_F(OrderOfEscapes, IgnoresEvidenceWhileAnEscapeIsAtWork) {
  detector_->trap = true;
  step();
  step();

  EXPECT_EQ(first_->begins, 1);
  EXPECT_EQ(detector_->observed, 2);
  EXPECT_TRUE(events().empty());
}

TEST_F(OrderOfEscapes, LogsATrapThatTheEscapeAtWorkTakesUp) {
  detector_->trap = true;
  step();
  first_->takes_up = true;
  step();

  EXPECT_EQ(events(), std::vector<EventKind>{EventKind::kTrap});
  EXPECT_EQ(first_->begins, 1);
  EXPECT_EQ(detector_->ends, 1);
  EXPECT_EQ(shadow_->ends, 1);
}

TEST_F(OrderOfEscapes, FallsBackOnTheNextEscape) {
  detector_->trap = true;
  step();
  first_->status = EscapeStatus::kFailed;
  step();
  const auto handed_over = events();
  const domain::Guidance& guidance = step();

  EXPECT_EQ(handed_over,
            (std::vector<EventKind>{EventKind::kEscapeFailed, EventKind::kEscapeBegun}));
  EXPECT_EQ(guidance.override_motion.turn_rad, 0.2);
  EXPECT_EQ(detector_->ends, 0);
}

TEST_F(OrderOfEscapes, StartsAfreshWhenTheLastEscapeFails) {
  detector_->trap = true;
  step();
  first_->status = second_->status = EscapeStatus::kFailed;
  step();
  detector_->trap = false;
  const domain::Guidance& guidance = step();

  EXPECT_EQ(guidance.mode, GuidanceMode::kSeek);
  EXPECT_EQ(events(), std::vector<EventKind>{EventKind::kEscapeFailed});
  EXPECT_EQ(event(0).text, "told");
  EXPECT_EQ(detector_->ends, 1);
  EXPECT_EQ(step().why, "all escapes failed, at last second: told");
}

TEST_F(OrderOfEscapes, GoesOnWithTheEscapeThatTookOverUntilTheLastHasFailed) {
  detector_->trap = true;
  step();
  first_->status = EscapeStatus::kFailed;
  second_->status = EscapeStatus::kEnded;
  step();  // the second takes over
  step();  // and ends
  step();  // the next trap is its own

  EXPECT_EQ(first_->begins, 1);
  EXPECT_EQ(second_->begins, 2);

  second_->status = EscapeStatus::kFailed;
  step();
  step();

  EXPECT_EQ(first_->begins, 2);
}

TEST_F(OrderOfEscapes, GivesUpForGood) {
  detector_->trap = true;
  step();
  first_->status = EscapeStatus::kUnreachable;

  EXPECT_EQ(step().mode, GuidanceMode::kUnreachable);
  EXPECT_EQ(events(), std::vector<EventKind>{EventKind::kUnreachable});
  EXPECT_EQ(step().mode, GuidanceMode::kUnreachable);
  EXPECT_EQ(step().why, "first: told");
}

}  // namespace
}  // namespace clew::recover
