// SPDX-License-Identifier: Apache-2.0
#include "recorder/black_box.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "../recording/scratch_directory.hpp"
#include "recorded_run.hpp"
#include "recorder/recorder_process.hpp"
#include "replay/black_box_past.hpp"
#include "replay/branch.hpp"
#include "replay/component_replay.hpp"
#include "run/composed_run.hpp"

namespace clew::replay_test {
namespace {

using namespace bridge;
using domain::Topic;
using recording_test::read_bytes;
using recording_test::ScratchDirectory;

// 9 s are 30 ticks of 0.3 s.
constexpr double kKeep_s = 9.0;
constexpr std::uint64_t kKeepTicks = 30;

struct State {
  std::string stage;
  std::uint64_t tick = 0;
  std::string bytes;
};
struct Sample {
  Topic topic = Topic::kCommand;
  std::uint64_t tick = 0;
  std::uint64_t sequence = 0;
  std::string cdr;
};

/// Keeps all that a run gives to a black box, to give it again in another order.
class Tape : public SampleSink {
 public:
  core::Result<void> add(const SampleView& sample) override {
    samples.push_back({sample.topic, sample.tick, sample.sequence, std::string(sample.cdr)});
    return {};
  }
  bool wants_states() const override { return true; }
  void add_state(const SpooledState& state) override {
    states.push_back({std::string(state.stage), state.tick, std::string(state.state)});
  }

  /// Gives the ticks from `from` to before `to` as a composed run does.
  void play(RunSink& sink, std::uint64_t from, std::uint64_t to) const {
    auto state = states.begin();
    for (const Sample& s : samples) {
      for (; state != states.end() && state->tick <= s.tick; ++state) {
        if (state->tick >= from && state->tick < to) {
          sink.add_state({state->stage, state->tick, state->bytes});
        }
      }
      if (s.tick < from || s.tick >= to) continue;
      ASSERT_TRUE(sink.add({s.topic, s.tick, s.sequence, s.cdr}).ok());
    }
  }

  std::vector<Sample> samples;
  std::vector<State> states;
};

class BlackBoxOfRun : public testing::Test {
 protected:
  RecordingOrder order(const runtime::RunPlan& plan, const std::string& path) {
    EXPECT_TRUE(mcap::OutputFile::reserve(path, true).ok());
    return {path, describe_run(plan), kKeep_s};
  }

  /// Runs a plan with a black box.
  RecordingAccount record(const runtime::RunPlan& plan, const std::string& path) {
    auto box = open_sink(order(plan, path));
    EXPECT_TRUE(box.ok()) << box.error().text();
    const auto report = run_composed(plan, {}, box->get(), {});
    EXPECT_TRUE(report.ok()) << report.error().text();
    return (*box)->close({report->aborted, false});
  }

  /// The first tick at which a run through the u-trap notices it: tests/replay/branch_test.cpp.
  static constexpr std::uint64_t kTrapTick = 112;

  runtime::RunPlan plan_ = plan_of("krishna_kalra", changes({}, {}, 400));
  ScratchDirectory scratch_;
  std::string path_ = scratch_.file("box.mcap");
};

TEST_F(BlackBoxOfRun, BeginsAtTheCheckpointBeforeWhatItKeeps) {
  record(plan_, path_);

  const RunRecording recording = open_recording(path_);

  // Trap at 112, 30 ticks back is 82, the checkpoint before that 64; the tick before is there, too.
  ASSERT_TRUE(recording.description().black_box.has_value());
  EXPECT_EQ(recording.description().black_box->tick, 64u);
  EXPECT_EQ(recording.description().black_box->why, "landmark_revisit noticed a trap at tick 112");
  const auto survey = recording.survey();
  ASSERT_TRUE(survey.ok()) << survey.error().text();
  EXPECT_EQ(survey->topics.size(), 8u);
  for (const auto& [topic, found] : survey->topics) {
    EXPECT_EQ(found.first_tick, 63u) << domain::topic_name(topic);
    EXPECT_EQ(found.missing_ticks, 0u) << domain::topic_name(topic);
  }
}

TEST_F(BlackBoxOfRun, HoldsTheSameSamplesAsAFullRecording) {
  const std::string full_path = scratch_.file("full.mcap");
  record_run(plan_, full_path);
  record(plan_, path_);

  const RunRecording full = open_recording(full_path);
  const RunRecording box = open_recording(path_);
  SampleFilter filter;
  filter.first_tick = 63;
  SampleStream from_full = full.samples(filter);
  SampleStream from_box = box.samples();
  for (std::size_t i = 0;; ++i) {
    const auto expected = from_full.next();
    const auto found = from_box.next();
    ASSERT_TRUE(expected.ok() && found.ok());
    ASSERT_EQ(expected->has_value(), found->has_value()) << "at sample " << i;
    if (!expected->has_value()) break;

    EXPECT_EQ((*expected)->tick, (*found)->tick);
    EXPECT_EQ((*expected)->topic, (*found)->topic);
    EXPECT_EQ((*expected)->cdr, (*found)->cdr) << "at tick " << (*found)->tick;
  }
}

TEST_F(BlackBoxOfRun, EveryComponentReplaysFromIt) {
  record(plan_, path_);
  const RunRecording recording = open_recording(path_);

  for (const auto& stage : plan_.graph.stages) {
    const auto report = replay_component(recording, replay_plan(recording), stage.info->name);

    ASSERT_TRUE(report.ok()) << report.error().text();
    EXPECT_TRUE(report->identical()) << stage.info->name;
    EXPECT_TRUE(report->has_past);
    EXPECT_EQ(report->ticks, recording.survey()->topics.at(Topic::kState).last_tick - 64 + 1);
  }
}

TEST_F(BlackBoxOfRun, AnotherBehaviourBeginsThereWithoutAPast) {
  record(plan_, path_);
  const RunRecording recording = open_recording(path_);
  const auto changed = replay_plan(recording, changes({"recover.escape=virtual_obstacle"}, {}));

  const auto report = replay_component(recording, changed, "recover");

  // It seeks as the recorded one does until it has seen the trap, which it has to find out anew:
  // no difference lies before the trap.
  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_FALSE(report->has_past);
  ASSERT_TRUE(report->first.has_value());
  EXPECT_GE(report->first->tick, kTrapTick);
}

TEST_F(BlackBoxOfRun, ABranchWithoutAChangeIsTheSameRun) {
  record(plan_, path_);
  const RunRecording recording = open_recording(path_);
  const auto plan = replay_plan(recording);

  auto start = branch_off(recording, plan, plan, 100);

  ASSERT_TRUE(start.ok()) << start.error().text();
  const auto report = run_composed(plan, std::move(start).value(), {}, nullptr, {});
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->hash->hex(), recording.end()->hash.hex());
}

TEST_F(BlackBoxOfRun, WritesTheSameBytesInWhateverOrderTopicsDeliver) {
  record(plan_, path_);
  Tape tape;
  ASSERT_TRUE(run_composed(plan_, {}, &tape, {}).ok());
  const std::string other = scratch_.file("other.mcap");

  // Batches of 50 ticks, topic by topic, and before each topic's the states of that time.
  auto box = open_sink(order(plan_, other));
  ASSERT_TRUE(box.ok()) << box.error().text();
  const std::uint64_t last = tape.samples.back().tick;
  for (std::uint64_t begin = 0; begin <= last; begin += 50) {
    const auto in_batch = [&](std::uint64_t tick) { return tick >= begin && tick < begin + 50; };
    for (const State& state : tape.states) {
      if (in_batch(state.tick)) (*box)->add_state({state.stage, state.tick, state.bytes});
    }
    for (auto topic = domain::kAllTopics.rbegin(); topic != domain::kAllTopics.rend(); ++topic) {
      for (const Sample& s : tape.samples) {
        if (s.topic != *topic || !in_batch(s.tick)) continue;
        ASSERT_TRUE((*box)->add({s.topic, s.tick, s.sequence, s.cdr}).ok());
      }
    }
  }
  EXPECT_EQ((*box)->close({}).failure, "");

  EXPECT_EQ(read_bytes(other), read_bytes(path_));
}

TEST_F(BlackBoxOfRun, RecordersThatDieLeaveTheSameBytes) {
  record(plan_, path_);
  Tape tape;
  ASSERT_TRUE(run_composed(plan_, {}, &tape, {}).ok());

  // Before the trap, just after it, and later on.
  for (const std::uint64_t death : {std::uint64_t{90}, kTrapTick + 1, kTrapTick + 20}) {
    const std::string other = scratch_.file("other" + std::to_string(death) + ".mcap");
    const RecordingOrder what = order(plan_, other);
    Kept kept;
    {
      auto first = open_sink(what);
      ASSERT_TRUE(first.ok());
      tape.play(**first, 0, death);
      ASSERT_TRUE((*first)->write_ahead().ok());
      kept = (*first)->kept();
    }
    auto second = open_sink(what, kept.durable_ticks);
    ASSERT_TRUE(second.ok()) << second.error().text();
    tape.play(**second, kept.durable_ticks, UINT64_MAX);
    EXPECT_EQ((*second)->close({}).failure, "");

    EXPECT_EQ(read_bytes(other), read_bytes(path_)) << "died at tick " << death;
  }
}

TEST_F(BlackBoxOfRun, KeepsAsMuchOfALongRunAsOfAShortOne) {
  Tape tape;
  const auto plan = plan_of("reactive", changes({}, {}, 2000));
  ASSERT_TRUE(run_composed(plan, {}, &tape, {}).ok());
  auto box = open_sink(order(plan, path_));
  ASSERT_TRUE(box.ok());

  std::uint64_t most = 0;
  for (const Sample& s : tape.samples) {
    ASSERT_TRUE((*box)->add({s.topic, s.tick, s.sequence, s.cdr}).ok());
    const Kept kept = (*box)->kept();
    if (s.tick < 1900) most = std::max(most, kept.ticks - kept.durable_ticks);
  }

  // What it keeps, less than a checkpoint period before that, and the tick before.
  EXPECT_GT(most, kKeepTicks);
  EXPECT_LE(most, kKeepTicks + kTicksPerCheckpoint + 1);
}

TEST_F(BlackBoxOfRun, WritesWhenTheTimeIsOver) {
  record(plan_of("reactive", changes({}, {}, 200)), path_);

  const RunRecording recording = open_recording(path_);

  EXPECT_EQ(recording.description().black_box->why, "the run's time is over at tick 200");
  // 170 is 30 ticks before.
  EXPECT_EQ(recording.description().black_box->tick, 128u);
}

TEST_F(BlackBoxOfRun, WritesWhenTheRobotCollides) {
  auto overrides = changes({}, {"drive.safety=false", "control.guard=false"}, 3000);
  overrides.world = "comb";
  record(plan_of("reactive", overrides), path_);

  const RunRecording recording = open_recording(path_);

  EXPECT_NE(recording.description().black_box->why.find("a collision at tick"), std::string::npos)
      << recording.description().black_box->why;
}

TEST_F(BlackBoxOfRun, WritesNothingIfNothingHappens) {
  const auto plan = plan_of("krishna_kalra", in_world("open-field", 400));

  const RecordingAccount account = record(plan, path_);

  EXPECT_TRUE(account.nothing);
  EXPECT_EQ(account.failure, "");
}

TEST_F(BlackBoxOfRun, WritesWhenTheRunIsAborted) {
  const auto plan = plan_of("krishna_kalra", in_world("open-field", 400));
  auto box = open_sink(order(plan, path_));
  ASSERT_TRUE(box.ok());
  ASSERT_TRUE(run_composed(plan, {}, box->get(), {}).ok());

  EXPECT_FALSE((*box)->close({"interrupted", false}).nothing);

  EXPECT_EQ(open_recording(path_).description().black_box->why.rfind("the run was aborted", 0), 0u);
}

TEST(BlackBoxFirstTick, IsACheckpoint) {
  EXPECT_EQ(BlackBox::first_tick(10, 30), 0u);
  EXPECT_EQ(BlackBox::first_tick(93, 30), 0u);     // 63
  EXPECT_EQ(BlackBox::first_tick(94, 30), 64u);    // 64
  EXPECT_EQ(BlackBox::first_tick(300, 30), 256u);  // 270
}

}  // namespace
}  // namespace clew::replay_test
