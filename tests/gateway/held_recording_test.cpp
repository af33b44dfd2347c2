// SPDX-License-Identifier: Apache-2.0
#include "gateway/held_recording.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "gateway/kept_texts.hpp"
#include "recording/run_recording.hpp"
#include "run/sample_account.hpp"
#include "run/spool.hpp"
#include "runtime/intervention.hpp"
#include "stages/all.hpp"
#include "tests/source_path.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using domain::Topic;

class AHeldRun : public ::testing::Test {
 protected:
  AHeldRun() {
    RunDescription description;
    description.tick_s = 0.1;
    description.schemas = {{Topic::kScan, std::string(idl_text(Topic::kScan))},
                           {Topic::kState, std::string(idl_text(Topic::kState))}};
    stream_.describe(description, "run", 2);
  }

  void add_states(std::uint64_t tick, const std::vector<std::string>& stages,
                  const std::string& more = {}) {
    std::string spool;
    for (const std::string& stage : stages) {
      const std::string state = "of " + stage + more;
      append_to_spool(SpooledState{stage, tick, state}, spool);
    }
    stream_.add(spool);
  }

  void add_tick(std::uint64_t tick) {
    std::string spool;
    append_to_spool({Topic::kScan, tick, tick, "scan"}, spool);
    append_to_spool({Topic::kState, tick, tick, "state"}, spool);
    stream_.add(spool);
  }

  /// The texts once changes are in force name them.
  core::Result<HeldRecording> write(std::uint64_t last_tick) const {
    return HeldRecording::write(stream_, last_tick,
                                [](const auto& description, const auto& changes) {
                                  auto texts = description.bundle;
                                  for (const auto& each : changes)
                                    texts["graph.yaml"] += each.changes.front() + '\n';
                                  return core::Result<std::map<std::string, std::string>>(texts);
                                });
  }

  LiveStream stream_{1340};  // some seventeen ticks
};

TEST_F(AHeldRun, IsARecordingUpToTheTickThatIsAsked) {
  for (std::uint64_t tick = 0; tick < 10; ++tick) add_tick(tick);
  stream_.add(spooled({4, 4, {"goal=1,2"}, {}, {}}));
  stream_.add(spooled({9, 9, {"goal=3,4"}, {}, {}}));

  const auto held = write(6);
  ASSERT_TRUE(held.ok()) << held.error().text();
  const auto recording = RunRecording::open(held->path());
  ASSERT_TRUE(recording.ok()) << recording.error().text();

  const auto survey = recording->survey_samples();
  ASSERT_TRUE(survey.ok()) << survey.error().text();
  EXPECT_EQ(survey->topics.at(Topic::kState).samples, 7U);
  EXPECT_EQ(survey->topics.at(Topic::kScan).last_tick, 6U);
  ASSERT_EQ(recording->interventions().size(), 1U);
  EXPECT_EQ(recording->interventions()[0].tick, 4U);
}

TEST_F(AHeldRun, LeavesNoFile) {
  add_tick(0);
  std::string path;
  {
    const auto held = write(0);
    ASSERT_TRUE(held.ok()) << held.error().text();
    path = held->path();
    EXPECT_TRUE(std::filesystem::exists(path) || std::filesystem::is_symlink(path));
  }

  EXPECT_FALSE(std::filesystem::is_symlink(path));
}

TEST_F(AHeldRun, IsRefusedBeforeItsFirstTickAndBeyondItsNewest) {
  EXPECT_EQ(write(0).error().message, "the run has not begun");

  add_tick(0);
  EXPECT_EQ(write(1).error().message, "the run is at tick 0");
}

TEST_F(AHeldRun, IsRefusedWhenItsBeginningIsForgotten) {
  for (std::uint64_t tick = 0; tick < 100; ++tick) add_tick(tick);

  const auto held = write(99);
  ASSERT_FALSE(held.ok());
  EXPECT_EQ(held.error().message.find("what came before tick 99 is not held here"), 0U);
}

TEST_F(AHeldRun, BeginsAtTheNewestCheckpointOfWhichAllStatesAreHeld) {
  for (std::uint64_t tick = 0; tick < 100; ++tick) {
    if (tick == 90) add_states(tick, {"drive", "sense"});
    if (tick == 94) add_states(tick, {"drive"});
    add_tick(tick);
  }

  const auto held = write(98);
  ASSERT_TRUE(held.ok()) << held.error().text();
  const auto recording = RunRecording::open(held->path());
  ASSERT_TRUE(recording.ok()) << recording.error().text();
  const auto& box = recording->description().black_box;
  ASSERT_TRUE(box.has_value());
  EXPECT_EQ(box->tick, 90U);
  EXPECT_EQ(box->states,
            (std::map<std::string, std::string>{{"drive", "of drive"}, {"sense", "of sense"}}));
  const auto survey = recording->survey_samples();
  ASSERT_TRUE(survey.ok()) << survey.error().text();
  EXPECT_EQ(survey->topics.at(Topic::kState).first_tick, 89U);
  EXPECT_EQ(survey->topics.at(Topic::kState).last_tick, 98U);
}

TEST_F(AHeldRun, BeginsWhereNoBehaviourIsOnItsWayIn) {
  for (std::uint64_t tick = 0; tick < 10; ++tick) {
    if (tick == 4 || tick == 8) add_states(tick, {"drive", "sense"});
    add_tick(tick);
  }
  ASSERT_EQ(stream_.start_before(9)->tick, 8U);

  stream_.add(spooled({8, 5, {"recover.detector=none"}, {}, {}}));

  EXPECT_EQ(stream_.start_before(9)->tick, 4U);
  EXPECT_EQ(stream_.start_before(6)->tick, 4U);
  stream_.add(spooled({9, 0, {"recover.detector=none"}, {}, {}}));
  EXPECT_EQ(stream_.start_before(9)->tick, 0U);
}

TEST_F(AHeldRun, HasWhatWasChangedBeforeItInItsTexts) {
  stream_.add(spooled({5, 2, {"recover.detector=none"}, {}, {}}));
  stream_.add(spooled({6, 6, {}, "pause", {}}));
  stream_.add(spooled({9, 9, {"goal=1,2"}, {}, {}}));
  for (std::uint64_t tick = 0; tick < 10; ++tick) {
    if (tick == 8) add_states(tick, {"drive", "sense"});
    add_tick(tick);
  }

  const auto held = write(9);
  ASSERT_TRUE(held.ok()) << held.error().text();
  const auto recording = RunRecording::open(held->path());
  ASSERT_TRUE(recording.ok()) << recording.error().text();

  ASSERT_TRUE(recording->description().black_box.has_value());
  EXPECT_EQ(recording->description().black_box->tick, 8U);
  EXPECT_EQ(recording->description().bundle.at("graph.yaml"), "recover.detector=none\n");
  ASSERT_EQ(recording->interventions().size(), 1U);
  EXPECT_EQ(recording->interventions()[0].tick, 9U);
}

/// Two changes of rules, whose files are among those that the run was made of.
std::vector<domain::Intervention> planned_rules(std::map<std::string, std::string>& bundle) {
  const runtime::ConfigPath shipped({tests::source_path("configs")});
  auto plan = runtime::prepare_run("wang_yang_meng", {}, shipped, stages::all());
  EXPECT_TRUE(plan.ok()) << plan.error().text();
  std::vector<domain::Intervention> planned = {
      runtime::planned_at(4, {"control.rules=wang_yang_meng"}),
      runtime::planned_at(20, {"control.rules=wang_yang_meng_printed"})};
  bundle = plan->bundle;
  for (domain::Intervention& each : planned) {
    const auto after = runtime::change(*plan, shipped, stages::all(), each);
    EXPECT_TRUE(after.ok()) << after.error().text();
    bundle.merge(each.files);
    each.files.clear();
  }
  return planned;
}

TEST_F(AHeldRun, HasTheFilesOfPlannedChangesThatWereAndThatAreToCome) {
  RunDescription description = *stream_.description();
  description.planned = planned_rules(description.bundle);
  stream_.describe(description, "run", 2);
  for (const auto& each : description.planned) stream_.add(spooled(each));
  for (std::uint64_t tick = 0; tick < 10; ++tick) {
    if (tick == 8) add_states(tick, {"drive", "sense"});
    add_tick(tick);
  }

  const auto held = HeldRecording::write(stream_, 9, [](const auto& run, const auto& changes) {
    return runtime::changed_bundle(run.bundle, changes, stages::all());
  });
  ASSERT_TRUE(held.ok()) << held.error().text();
  const auto recording = RunRecording::open(held->path());
  ASSERT_TRUE(recording.ok()) << recording.error().text();

  ASSERT_TRUE(recording->description().black_box.has_value());
  const auto& bundle = recording->description().bundle;
  EXPECT_NE(bundle.at("graph.yaml").find("rules: wang_yang_meng\n"), std::string::npos)
      << bundle.at("graph.yaml");
  for (const auto& [name, text] : description.bundle) {
    EXPECT_EQ(bundle.count(name), 1U) << name;
  }
  ASSERT_EQ(recording->description().planned.size(), 1U);
  EXPECT_TRUE(
      runtime::changed_bundle(bundle, recording->description().planned, stages::all()).ok());
}

TEST_F(AHeldRun, IsNotPlannedAnewForTheNextQuestionAfterTheSameChanges) {
  stream_.add(spooled({5, 5, {"goal=1,2"}, {}, {}}));
  for (std::uint64_t tick = 0; tick < 10; ++tick) {
    if (tick == 6 || tick == 8) add_states(tick, {"drive", "sense"});
    add_tick(tick);
  }
  int made = 0;
  KeptTexts texts([&made](const RunDescription& description, const auto& changes) {
    auto bundle = description.bundle;
    bundle["graph.yaml"] = std::to_string(++made) + " after " + std::to_string(changes.size());
    return KeptTexts::Texts(bundle);
  });
  const auto graph_at = [&](std::uint64_t tick) {
    const auto held = HeldRecording::write(stream_, tick, std::ref(texts));
    EXPECT_TRUE(held.ok()) << held.error().text();
    const auto recording = RunRecording::open(held->path());
    EXPECT_TRUE(recording.ok()) << recording.error().text();
    return recording->description().bundle.at("graph.yaml");
  };

  EXPECT_EQ(graph_at(7), "1 after 1");
  EXPECT_EQ(graph_at(9), "1 after 1") << "no other change took effect in between";

  stream_.add(spooled({10, 10, {"goal=3,4"}, {}, {}}));
  add_tick(10);
  add_states(11, {"drive", "sense"});
  add_tick(11);
  EXPECT_EQ(graph_at(11), "2 after 2");
  EXPECT_EQ(graph_at(9), "1 after 1");
  EXPECT_EQ(made, 2);
}

TEST_F(AHeldRun, IsRefusedBeforeItsOnlyCheckpoint) {
  for (std::uint64_t tick = 0; tick < 100; ++tick) {
    if (tick == 90) add_states(tick, {"drive", "sense"});
    add_tick(tick);
  }

  EXPECT_FALSE(write(89).ok());
  EXPECT_TRUE(write(90).ok());
}

TEST_F(AHeldRun, TakesNoCheckpointBehindALostTick) {
  for (std::uint64_t tick = 80; tick < 100; ++tick) {
    if (tick == 90) add_states(tick, {"drive", "sense"});
    if (tick != 89) add_tick(tick);
  }

  EXPECT_FALSE(write(98).ok());
}

TEST_F(AHeldRun, HoldsStatesUpToAQuarterOfItsRoom) {
  for (std::uint64_t tick = 85; tick < 100; ++tick) {
    add_states(tick, {"drive", "sense"}, std::string(30, '.'));
    add_tick(tick);
  }

  const auto start = stream_.start_before(99);
  ASSERT_TRUE(start.has_value());
  EXPECT_EQ(start->tick, 99U);
  EXPECT_FALSE(stream_.start_before(90).has_value());
}

TEST_F(AHeldRun, IsRefusedWhenATickBetweenWasLost) {
  add_tick(0);
  add_tick(2);

  const auto held = write(2);
  ASSERT_FALSE(held.ok());
  EXPECT_EQ(held.error().message.find("what came before tick 2 is not held here"), 0U);
}

}  // namespace
}  // namespace clew::bridge
