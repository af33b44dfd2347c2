// SPDX-License-Identifier: Apache-2.0
#include "recover/recover_component.hpp"

#include <gtest/gtest.h>

#include "tests/recover/scene.hpp"
#include "tests/source_files.hpp"

namespace clew::recover {
namespace {

using tests::rule_base;

using domain::EventKind;
using domain::GuidanceMode;
using domain::Topic;

/// Says trap when it is told to.
class ToldDetector final : public TrapDetector {
 public:
  std::optional<TrapEvidence> observe(const Situation& situation) override {
    ++observed;
    pursued = situation.pursued_odom;
    if (!trap) return std::nullopt;
    if (at_a_glance) return TrapEvidence{std::nullopt, "seen"};
    return TrapEvidence{EarlierVisit{3, {1, 2}, 9.0, 7}, "told so"};
  }
  void start_afresh() override { ++ends; }
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}

  bool trap = false;
  bool at_a_glance = false;
  core::Vec2 pursued = core::Vec2::Zero();
  int observed = 0;
  int ends = 0;
};

/// Turns by an angle of its own, and ends as it is told to.
class ToldEscape final : public Escape {
 public:
  explicit ToldEscape(double turn_rad) : turn_rad_(turn_rad) {}
  void watch(const Situation& situation) override {
    ++watched;
    local_map = situation.local_map;
  }
  void begin(const Situation&, const TrapEvidence& evidence) override {
    ++begins;
    reason = evidence.text;
  }
  bool take_up(const Situation&, const TrapEvidence&) override { return takes_up; }
  EscapeStatus step(const Situation&, domain::Guidance& guidance) override {
    if (virtual_target) {
      guidance.target_x_m = virtual_target->x();
      guidance.target_y_m = virtual_target->y();
      guidance.target_is_virtual = true;
    } else {
      guidance.has_override = true;
      guidance.override_motion.turn_rad = turn_rad_;
    }
    guidance.why = "told";
    return status;
  }
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}

  EscapeStatus status = EscapeStatus::kActive;
  bool takes_up = false;
  std::optional<core::Vec2> virtual_target;
  int begins = 0;
  int watched = 0;
  const map::LocalMap* local_map = nullptr;
  std::string reason;

 private:
  double turn_rad_;
};

class RecoverComponentTest : public ::testing::Test {
 protected:
  RecoverComponentTest() {
    make_component();
    for (const Topic topic : {Topic::kOdometry, Topic::kScan, Topic::kTarget, Topic::kLandmark}) {
      inputs_.set(index_of(topic));
    }
    for (const Topic topic : {Topic::kGuidance, Topic::kEvent}) {
      outputs_.set(index_of(topic));
    }
  }

  void make_component(std::optional<map::LocalMap> local_map = {}) {
    RecoverComponent::Parts parts;
    parts.local_map = std::move(local_map);
    detector_ = add(parts.detector, "told", std::make_unique<ToldDetector>());
    shadow_ = add(parts.shadows.emplace_back(), "watcher", std::make_unique<ToldDetector>());
    first_ = add(parts.escapes.emplace_back(), "first", std::make_unique<ToldEscape>(0.1));
    second_ = add(parts.escapes.emplace_back(), "second", std::make_unique<ToldEscape>(0.2));
    parts.immediate_memory = ImmediateMemory::parse(rule_base("krishna_kalra_actions")).value();
    component_ = std::make_unique<RecoverComponent>(std::move(parts));
  }

  template <typename Told, typename Behaviour>
  static Told* add(Named<Behaviour>& slot, const char* name, std::unique_ptr<Told> behaviour) {
    Told* told = behaviour.get();
    slot.name = name;
    slot.behaviour = std::move(behaviour);
    return told;
  }

  const domain::Guidance& step(const Scene& scene = {}) {
    std::get<domain::Odometry>(messages_) = scene.odometry();
    std::get<domain::Scan>(messages_) = scene.scan();
    std::get<domain::Landmark>(messages_) = scene.landmark();
    std::get<domain::Target>(messages_).x_m = scene.target().x();
    std::get<domain::Target>(messages_).y_m = scene.target().y();
    std::get<domain::Guidance>(messages_) = {};
    std::get<domain::Event>(messages_) = {};
    runtime::TickOutputs outputs(messages_, outputs_);
    component_->step({messages_, inputs_, inputs_, tick_++}, outputs);
    return std::get<domain::Guidance>(messages_);
  }

  std::vector<EventKind> events() const {
    std::vector<EventKind> kinds;
    const auto& entries = std::get<domain::Event>(messages_).entries;
    for (const auto& entry : entries) kinds.push_back(entry.kind);
    return kinds;
  }
  const domain::EventEntry& event(std::size_t i) const {
    return std::get<domain::Event>(messages_).entries[i];
  }

  ToldDetector* detector_ = nullptr;
  ToldDetector* shadow_ = nullptr;
  ToldEscape* first_ = nullptr;
  ToldEscape* second_ = nullptr;
  std::unique_ptr<RecoverComponent> component_;
  domain::Messages messages_;
  runtime::TopicSet inputs_;
  runtime::TopicSet outputs_;
  std::uint64_t tick_ = 0;
};

TEST_F(RecoverComponentTest, SeeksTheMissionsTargetWithoutATrap) {
  const domain::Guidance& guidance = step(Scene().target(4, 5));

  EXPECT_EQ(guidance.mode, GuidanceMode::kSeek);
  EXPECT_EQ(guidance.target_x_m, 4.0);
  EXPECT_EQ(guidance.target_y_m, 5.0);
  EXPECT_FALSE(guidance.has_override);
  EXPECT_TRUE(events().empty());
}

TEST_F(RecoverComponentTest, StartsTheFirstEscapeInTheTickOfTheTrap) {
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

TEST_F(RecoverComponentTest, ShowsAllBehavioursTheSameSurroundings) {
  step();
  EXPECT_EQ(first_->local_map, nullptr);  // nobody has asked for them

  make_component(map::LocalMap({}, 0.15));
  step(Scene().at(2, 3, 0));

  ASSERT_NE(first_->local_map, nullptr);
  EXPECT_EQ(second_->local_map, first_->local_map);
  EXPECT_TRUE(first_->local_map->seen().is(map::Mark::kFree, {2, 3}));  // where it stands
}

TEST_F(RecoverComponentTest, ForgetsItsSurroundingsWhenTheEscapeLooksAgain) {
  make_component(map::LocalMap({}, 0.15));
  detector_->trap = true;
  first_->status = EscapeStatus::kLooksAgain;

  const domain::Guidance& guidance = step();

  EXPECT_EQ(guidance.mode, GuidanceMode::kRecover);  // the escape goes on
  EXPECT_TRUE(first_->local_map->seen().state().tiles.empty());
}

TEST_F(RecoverComponentTest, SavesItsSurroundingsOnce) {
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

TEST_F(RecoverComponentTest, IgnoresEvidenceWhileAnEscapeIsAtWork) {
  detector_->trap = true;
  step();
  step();

  EXPECT_EQ(first_->begins, 1);
  EXPECT_EQ(detector_->observed, 2);
  EXPECT_TRUE(events().empty());
}

TEST_F(RecoverComponentTest, LogsATrapThatTheEscapeAtWorkTakesUp) {
  detector_->trap = true;
  step();
  first_->takes_up = true;
  step();

  EXPECT_EQ(events(), std::vector<EventKind>{EventKind::kTrap});
  EXPECT_EQ(first_->begins, 1);
  EXPECT_EQ(detector_->ends, 1);
  EXPECT_EQ(shadow_->ends, 1);
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

TEST_F(RecoverComponentTest, FallsBackOnTheNextEscape) {
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

TEST_F(RecoverComponentTest, StartsAfreshWhenTheLastEscapeFails) {
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

TEST_F(RecoverComponentTest, GivesUpForGood) {
  detector_->trap = true;
  step();
  first_->status = EscapeStatus::kUnreachable;

  EXPECT_EQ(step().mode, GuidanceMode::kUnreachable);
  EXPECT_EQ(events(), std::vector<EventKind>{EventKind::kUnreachable});
  EXPECT_EQ(step().mode, GuidanceMode::kUnreachable);
  EXPECT_EQ(step().why, "first: told");
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
