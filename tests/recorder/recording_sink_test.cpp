// SPDX-License-Identifier: Apache-2.0
#include "recorder/recording_sink.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "../recording/scratch_directory.hpp"
#include "recorder/black_box.hpp"
#include "recorder/recorder_process.hpp"
#include "recording/output_file.hpp"
#include "recording/run_recording.hpp"
#include "short_run.hpp"

namespace clew::recorder_test {
namespace {

class Sink : public testing::Test {
 protected:
  std::unique_ptr<RunSink> open(double keep_last_s) {
    // The run has made the file before it has a recorder.
    EXPECT_TRUE(mcap::OutputFile::reserve(path_, true).ok());
    auto sink = open_sink(order_at(path_, keep_last_s));
    EXPECT_TRUE(sink.ok()) << sink.error().text();
    return std::move(sink).value();
  }
  RunRecording written() {
    auto recording = RunRecording::open(path_);
    EXPECT_TRUE(recording.ok()) << recording.error().text();
    return std::move(recording).value();
  }
  /// What made a box write.
  std::string why() { return written().description().black_box->why; }

  recording_test::ScratchDirectory directory_;
  std::string path_ = directory_.file("run.mcap");
};

domain::State state_with(domain::Outcome outcome, std::uint32_t collisions = 0,
                         std::uint32_t hit_by = 0) {
  domain::State state;
  state.outcome = outcome;
  state.collisions = collisions;
  state.hit_by = hit_by;
  return state;
}

/// A tick in which recovery says nothing.
std::string tick_of(const domain::State& state, std::uint64_t tick) {
  return spooled_sample(domain::Event(), tick) + spooled_sample(state, tick);
}

TEST(Spooling, IsAskedForByWhoRecordsOrLooksOn) {
  EXPECT_EQ(spooling_for({}, false), Spooling::kNothing);
  EXPECT_EQ(spooling_for({}, true), Spooling::kSamples);
  EXPECT_EQ(spooling_for(order_at("a"), false), Spooling::kSamples);
  EXPECT_EQ(spooling_for(order_at("a", 1.0), false), Spooling::kSamplesAndStates);
}

TEST(Recording, SaysOfARunWhatItsPlanSays) {
  runtime::RunPlan plan;
  plan.graph.tick_s = 0.1;
  plan.graph.seed = 7;
  plan.bundle = {{"graph.yaml", "world: u-trap\n"}};
  runtime::GraphStage drive;
  drive.ports.outputs.set(domain::index_of(domain::Topic::kState));
  plan.graph.stages = {drive};

  const RunDescription description = describe_run(plan);

  EXPECT_EQ(description.tick_s, 0.1);
  EXPECT_EQ(description.seed, 7u);
  EXPECT_EQ(description.bundle, plan.bundle);
  EXPECT_EQ(description.idl_fingerprint, idl_fingerprint());
  EXPECT_FALSE(description.versions.at("clew").empty());
  ASSERT_EQ(description.schemas.size(), 1u);
  EXPECT_EQ(description.schemas.at(domain::Topic::kState), idl_text(domain::Topic::kState));
}

TEST_F(Sink, IsMadeOfAPlanOnceUnlessItMayOverwrite) {
  runtime::RunPlan plan;
  plan.graph.tick_s = 0.1;
  runtime::GraphStage drive;
  drive.ports.outputs.set(domain::index_of(domain::Topic::kState));
  plan.graph.stages = {drive};
  {
    auto sink = RecordingSink::create(plan, path_, false);
    ASSERT_TRUE(sink.ok()) << sink.error().text();
    EXPECT_FALSE((*sink)->wants_states());
    EXPECT_TRUE(add(**sink, spooled_sample(domain::State(), 0)).ok());
    EXPECT_EQ((*sink)->close({}).failure, "");
  }
  EXPECT_EQ(last_tick(written()), 0u);

  EXPECT_FALSE(RecordingSink::create(plan, path_, false).ok());
  EXPECT_TRUE(RecordingSink::create(plan, path_, true).ok());
}

TEST_F(Sink, KeepsTheTemporaryNameOfASealedFile) {
  auto sink = open(0.0);
  EXPECT_TRUE(add(*sink, quiet_ticks(0, 4)).ok());

  EXPECT_EQ(sink->close({"", true}).failure, "");

  EXPECT_FALSE(RunRecording::open(path_).ok());
  EXPECT_TRUE(RunRecording::open(mcap::OutputFile::temporary_name(path_)).ok());
}

TEST_F(Sink, OfAWholeRunHoldsEveryTick) {
  auto sink = open(0.0);
  EXPECT_TRUE(add(*sink, quiet_ticks(0, 20)).ok());
  EXPECT_TRUE(sink->write_ahead().ok());
  sink->add_incident({3, "refused", "sense", "why"});

  EXPECT_EQ(sink->close({}).failure, "");
  EXPECT_EQ(last_tick(written()), 19U);
  EXPECT_EQ(written().incidents().size(), 1U);
}

TEST_F(Sink, SaysWhatItLacks) {
  auto sink = open(0.0);
  EXPECT_TRUE(add(*sink, quiet_ticks(0, 4) + quiet_ticks(6, 8)).ok());

  const RecordingAccount told = sink->close({"it was aborted", false});

  EXPECT_EQ(told.lost_samples, 4U);
  EXPECT_FALSE(told.losses.empty());
}

TEST_F(Sink, OfABlackBoxWritesNothingWhenNothingHappens) {
  auto box = open(1.0);
  EXPECT_TRUE(add(*box, quiet_ticks(0, 300)).ok());
  EXPECT_TRUE(box->write_ahead().ok());
  EXPECT_EQ(box->kept().ticks, 300U);

  EXPECT_TRUE(box->close({}).nothing);
}

TEST_F(Sink, OfABlackBoxWritesWhenTheRobotCollides) {
  auto box = open(1.0);
  EXPECT_TRUE(add(*box, quiet_ticks(0, 100)).ok());
  EXPECT_TRUE(add(*box, tick_of(state_with(domain::Outcome::kRunning, 1), 100)).ok());
  EXPECT_TRUE(add(*box, quiet_ticks(101, 110)).ok());

  EXPECT_FALSE(box->close({"stopped", false}).nothing);
  EXPECT_EQ(why(), "a collision at tick 100");
}

TEST_F(Sink, OfABlackBoxWritesWhenSomethingHitsTheRobot) {
  auto box = open(1.0);
  EXPECT_TRUE(add(*box, quiet_ticks(0, 70)).ok());
  EXPECT_TRUE(add(*box, tick_of(state_with(domain::Outcome::kRunning, 0, 1), 70)).ok());

  EXPECT_FALSE(box->close({"stopped", false}).nothing);
  EXPECT_EQ(why(), "hit by an obstacle at tick 70");
}

TEST_F(Sink, OfABlackBoxWritesAtABadEndOnly) {
  const std::vector<std::pair<domain::Outcome, std::string>> ends = {
      {domain::Outcome::kCollided, "the run ended with a collision at tick 10"},
      {domain::Outcome::kUnreachable, "the target is unreachable at tick 10"},
      {domain::Outcome::kTimeout, "the run's time is over at tick 10"},
      {domain::Outcome::kReached, ""}};
  for (const auto& [outcome, expected] : ends) {
    auto box = open(1.0);
    EXPECT_TRUE(add(*box, quiet_ticks(0, 10) + tick_of(state_with(outcome), 10)).ok());

    const RecordingAccount told = box->close({});

    EXPECT_EQ(told.failure, "");
    EXPECT_EQ(told.nothing, expected.empty());
    if (!expected.empty()) {
      EXPECT_EQ(why(), expected);
    }
  }
}

TEST_F(Sink, OfABlackBoxWritesAtATrapButNotAtOneOfAShadow) {
  domain::Event event;
  event.entries.push_back({});
  event.entries[0].kind = domain::EventKind::kTrap;
  event.entries[0].rule = "oscillation";
  event.entries[0].shadow = true;
  auto box = open(1.0);
  EXPECT_TRUE(add(*box, spooled_sample(event, 0) + spooled_sample(domain::State(), 0)).ok());
  event.entries[0].shadow = false;
  EXPECT_TRUE(add(*box, spooled_sample(event, 1) + spooled_sample(domain::State(), 1)).ok());
  box->add_incident({1, "refused", "sense", "why"});

  EXPECT_FALSE(box->close({"stopped", false}).nothing);
  EXPECT_EQ(why(), "oscillation noticed a trap at tick 1");
}

TEST_F(Sink, OfABlackBoxWritesWhenTheRunIsAborted) {
  auto box = open(1.0);
  EXPECT_TRUE(add(*box, quiet_ticks(0, 10)).ok());

  EXPECT_FALSE(box->close({"sense died", false}).nothing);
  EXPECT_EQ(why(), "the run was aborted at tick 10");
}

TEST_F(Sink, OfABlackBoxHoldsTheStatesAndChangesFromWhichItCanBeReplayed) {
  auto box = open(1.0);  // ten ticks
  EXPECT_TRUE(box->wants_states());
  const auto state = [](std::uint64_t tick, const std::string& bytes) {
    std::string spool;
    append_to_spool(SpooledState{"drive", tick, bytes}, spool);
    return spool;
  };
  box->add_intervention({30, 30, {"goal=1,2"}, {}, {}});
  box->add_incident({31, "refused", "sense", "why"});
  EXPECT_TRUE(add(*box, quiet_ticks(0, 64) + state(64, "too old") + quiet_ticks(64, 128) +
                            state(128, "as it was") + quiet_ticks(128, 150))
                  .ok());
  EXPECT_TRUE(add(*box, tick_of(state_with(domain::Outcome::kRunning, 1), 150)).ok());
  EXPECT_FALSE(box->wants_states());

  EXPECT_EQ(box->close({"stopped", false}).failure, "");
  const RunRecording recording = written();
  ASSERT_TRUE(recording.description().black_box.has_value());
  EXPECT_EQ(recording.description().black_box->tick, 128u);
  EXPECT_EQ(recording.description().black_box->states,
            (std::map<std::string, std::string>{{"drive", "as it was"}}));
  ASSERT_EQ(recording.interventions().size(), 1u);
  EXPECT_EQ(recording.interventions()[0].changes, std::vector<std::string>{"goal=1,2"});
  ASSERT_EQ(recording.incidents().size(), 1u);
  EXPECT_EQ(recording.incidents()[0].tick, 31u);
}

TEST_F(Sink, OfABlackBoxDoesNotWaitForATopicThatStaysSilentForEver) {
  auto box = open(1.0);
  std::string spool = spooled_sample(state_with(domain::Outcome::kRunning, 0), 0) +
                      spooled_sample(state_with(domain::Outcome::kRunning, 1), 1);
  for (std::uint64_t tick = 2; tick < RunRecorder::kMaxWaitingTicks; ++tick) {
    spool += spooled_sample(state_with(domain::Outcome::kRunning, 1), tick);
  }
  EXPECT_TRUE(add(*box, spool).ok());
  EXPECT_TRUE(box->wants_states()) << "the event of tick 1 may still come";

  EXPECT_TRUE(add(*box, spooled_sample(state_with(domain::Outcome::kRunning, 1), 1024) +
                            spooled_sample(state_with(domain::Outcome::kRunning, 1), 1025))
                  .ok());

  EXPECT_FALSE(box->wants_states());
  EXPECT_FALSE(box->close({"stopped", false}).nothing);
  EXPECT_EQ(why(), "a collision at tick 1");
}

TEST_F(Sink, OfABlackBoxRefusesToGoOnWithWhatIsNoRecording) {
  std::ofstream(mcap::OutputFile::temporary_name(path_)) << "something else of somebody else";

  const auto box = open_sink(order_at(path_, 1.0));

  ASSERT_FALSE(box.ok());
  EXPECT_NE(box.error().text().find(path_), std::string::npos) << box.error().text();
}

TEST_F(Sink, OfABlackBoxPassesOverAMessageThatIsNone) {
  auto box = open(1.0);
  const std::string cdr = "no message";
  EXPECT_TRUE(box->add({domain::Topic::kEvent, 0, 0, cdr}).ok());
  EXPECT_TRUE(box->add({domain::Topic::kState, 0, 0, cdr}).ok());

  EXPECT_TRUE(box->close({}).nothing);
}

TEST_F(Sink, OfABlackBoxGoesOnWithAFileThatHoldsSamples) {
  {
    auto box = open(1.0);
    EXPECT_TRUE(add(*box, tick_of(state_with(domain::Outcome::kRunning), 0) +
                              tick_of(state_with(domain::Outcome::kRunning, 1), 1))
                    .ok());
    EXPECT_TRUE(add(*box, quiet_ticks(2, 100)).ok());
    EXPECT_TRUE(box->write_ahead().ok());
    // Its process is killed here.
  }
  auto again = open_sink(order_at(path_, 1.0));
  ASSERT_TRUE(again.ok()) << again.error().text();
  (*again)->add_incident({5, "refused", "sense", "why"});
  (*again)->add_intervention({});
  EXPECT_TRUE(add(**again, quiet_ticks(0, 120)).ok());

  EXPECT_EQ((*again)->close({}).failure, "");
  EXPECT_EQ(why(), "a collision at tick 1");
  EXPECT_EQ(last_tick(written()), 119U);
}

TEST_F(Sink, OfABlackBoxSaysWhyItCannotWrite) {
  auto order = order_at(directory_.file("no/such/folder/run.mcap"), 1.0);
  auto box = open_sink(order);
  ASSERT_TRUE(box.ok()) << box.error().text();
  EXPECT_FALSE(add(**box, tick_of(state_with(domain::Outcome::kTimeout), 0)).ok());

  EXPECT_NE((*box)->close({}).failure, "");
}

}  // namespace
}  // namespace clew::recorder_test
