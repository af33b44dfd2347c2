// SPDX-License-Identifier: Apache-2.0
#include "replay/branch.hpp"

#include <gtest/gtest.h>

#include <string>

#include "../recording/scratch_directory.hpp"
#include "process/recording_sink.hpp"
#include "recorded_run.hpp"
#include "recording_draft.hpp"
#include "replay/component_replay.hpp"
#include "replay/recorded_plan.hpp"
#include "replay/recording_diff.hpp"
#include "stages/all.hpp"

namespace clew::replay_test {
namespace {

using namespace bridge;
using domain::Topic;
using recording_test::ScratchDirectory;

constexpr std::uint64_t kMaxTicks = 400;

/// Branches off the recording of a run through the u-trap, in which a trap is found at tick 112.
class Branch : public testing::Test {
 protected:
  void SetUp() override {
    record_run(plan_of("krishna_kalra", changes({}, {}, kMaxTicks)), path_);
    last_tick_ = open_recording(path_).end()->ticks - 1;
  }

  /// Runs `plan` from `tick` on and records it; the report.
  RunReport branch(const RunRecording& recording, const runtime::RunPlan& plan, std::uint64_t tick,
                   const std::string& path) {
    auto start = branch_off(recording, plan, tick);
    EXPECT_TRUE(start.ok()) << start.error().text();
    auto sink = RecordingSink::create(plan, path, true);
    EXPECT_TRUE(sink.ok()) << sink.error().text();
    const auto copied = copy_samples_before(recording, tick, **sink);
    EXPECT_TRUE(copied.ok()) << copied.error().text();
    auto report = run_composed(plan, std::move(start).value(), {}, sink->get(), {});
    EXPECT_TRUE(report.ok()) << report.error().text();
    const auto closed = (*sink)->close();
    EXPECT_TRUE(closed.ok()) << closed.error().text();
    return std::move(report).value();
  }

  std::string refused(const runtime::RunPlan& plan, std::uint64_t tick) {
    const auto start = branch_off(open_recording(path_), plan, tick);
    return start.ok() ? "accepted" : start.error().text();
  }

  ScratchDirectory scratch_;
  std::string path_ = scratch_.file("run.mcap");
  std::string branch_path_ = scratch_.file("branch.mcap");
  std::uint64_t last_tick_ = 0;
};

TEST_F(Branch, WithoutAChangeIsTheSameRecordingByteForByte) {
  const RunRecording recording = open_recording(path_);
  const auto plan = replay_plan(recording);
  const std::string original = recording_test::read_bytes(path_);

  for (const std::uint64_t tick : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{111},
                                   std::uint64_t{113}, last_tick_ - 1, last_tick_}) {
    const RunReport report = branch(recording, plan, tick, branch_path_);

    EXPECT_EQ(report.hash, recording.end()->hash) << tick;
    EXPECT_EQ(report.tally.truth->tick, last_tick_);
    EXPECT_EQ(report.tally.traps_detected, 1U) << "those before the branch count";
    EXPECT_TRUE(recording_test::read_bytes(branch_path_) == original) << tick;
  }
}

/// A run in which another component takes over at a tick, made without a recording: old and new
/// components run side by side on the same inputs until then.
class TakeOver {
 public:
  TakeOver(const runtime::RunPlan& before, const runtime::RunPlan& after)
      : before_(std::move(runtime::make_nodes(before)).value()),
        after_(std::move(runtime::make_nodes(after)).value()) {}

  /// The samples of `ticks` ticks.
  std::vector<std::string> run(std::uint64_t branch_tick, std::uint64_t ticks) {
    std::vector<std::string> samples;
    for (std::uint64_t tick = 0; tick < ticks; ++tick) {
      const bool taken_over = tick >= branch_tick;
      for (std::size_t i = 0; i < before_.size(); ++i) {
        domain::Messages messages = messages_;
        runtime::Node& in_command = taken_over ? after_[i] : before_[i];
        if (!taken_over) step(after_[i], tick, messages);
        step(in_command, tick, messages_);
      }
      for (Topic topic : domain::kAllTopics) samples.push_back(encode(topic));
    }
    return samples;
  }

 private:
  static void step(runtime::Node& node, std::uint64_t tick, domain::Messages& messages) {
    runtime::TopicSet present = node.ports().inputs;
    if (tick > 0) present |= node.ports().delayed_inputs;
    node.step(tick, present, messages);
  }
  std::string encode(Topic topic) {
    return domain::visit_topic(topic, [&](auto constant) {
      constexpr auto kIndex = static_cast<std::size_t>(decltype(constant)::value);
      return std::string(std::get<kIndex>(codecs_).encode(std::get<kIndex>(messages_)));
    });
  }

  std::vector<runtime::Node> before_;
  std::vector<runtime::Node> after_;
  domain::Messages messages_;
  Codecs codecs_;
};

TEST_F(Branch, GoesOnAsIfTheNewComponentHadWatchedFromTheStart) {
  const RunRecording recording = open_recording(path_);
  for (const auto& change :
       {changes({}, {"recover.escape.leave=paper"}, kMaxTicks),
        changes({"recover.detector=none"}, {}, kMaxTicks),
        changes({}, {"control.behind_band_deg=60", "drive.max_step_m=0.1"}, kMaxTicks)}) {
    for (const std::uint64_t tick : {std::uint64_t{30}, std::uint64_t{115}}) {
      const auto plan = replay_plan(recording, change);

      branch(recording, plan, tick, branch_path_);

      const RecordingDraft draft = RecordingDraft::read(branch_path_);
      const auto expected = TakeOver(replay_plan(recording), plan)
                                .run(tick, draft.samples.size() / domain::kTopicCount);
      ASSERT_EQ(draft.samples.size(), expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i) {
        ASSERT_TRUE(draft.samples[i].cdr == expected[i])
            << "tick " << draft.samples[i].tick << " of "
            << domain::topic_name(draft.samples[i].topic);
      }
    }
  }
}

TEST_F(Branch, KeepsThePartBeforeAndDiffersAfter) {
  const RunRecording recording = open_recording(path_);
  const auto plan = replay_plan(recording, changes({}, {"drive.max_step_m=0.1"}, kMaxTicks));

  branch(recording, plan, 60, branch_path_);

  const auto diff = diff_recordings(recording, open_recording(branch_path_));
  ASSERT_TRUE(diff.ok()) << diff.error().text();
  ASSERT_FALSE(diff->identical());
  EXPECT_GE(diff->first->tick, 60U);
}

TEST_F(Branch, SaysInItsRecordingWhereItBeganAndOfWhat) {
  const RunRecording recording = open_recording(path_);
  auto plan = replay_plan(recording, changes({}, {"drive.max_step_m=0.1"}, kMaxTicks));
  note_branch(recording.description().bundle, 60, plan);
  branch(recording, plan, 60, branch_path_);
  const RunRecording branched = open_recording(branch_path_);

  const auto own = first_own_tick(branched);

  ASSERT_TRUE(own.ok()) << own.error().text();
  EXPECT_EQ(*own, 60U);
  EXPECT_EQ(*first_own_tick(recording), 0U);
  const auto& bundle = branched.description().bundle;
  EXPECT_EQ(bundle.at("before_branch/graph.yaml"), recording.description().bundle.at("graph.yaml"));
  EXPECT_EQ(bundle.count("before_branch/world.yaml"), 0U) << "it is the same";
}

TEST_F(Branch, IsReplayedFromWhereItBegan) {
  const RunRecording recording = open_recording(path_);
  auto plan = replay_plan(recording, changes({}, {"drive.max_step_m=0.1"}, kMaxTicks));
  note_branch(recording.description().bundle, 60, plan);
  branch(recording, plan, 60, branch_path_);
  const RunRecording branched = open_recording(branch_path_);
  const auto own_plan = recorded_plan(branched, stages::all());
  ASSERT_TRUE(own_plan.ok()) << own_plan.error().text();

  const auto from_there = replay_component(branched, *own_plan, "drive", {60});
  const auto whole = replay_component(branched, *own_plan, "drive");

  ASSERT_TRUE(from_there.ok() && whole.ok());
  // With the recorded commands the shorter steps lead elsewhere long before the branch.
  EXPECT_FALSE(whole->identical());
  EXPECT_TRUE(from_there->identical());
}

TEST_F(Branch, FindsTheComponentThatDoesNotDoWhatIsRecorded) {
  RecordingDraft draft = RecordingDraft::read(path_);
  draft.sample(Topic::kCommand, 40).cdr = draft.sample(Topic::kCommand, 41).cdr;
  draft.write(branch_path_);
  const RunRecording recording = open_recording(branch_path_);
  const auto recorded = replay_plan(recording);

  const auto before = find_unfaithful(recording, recorded, 40);
  const auto after = find_unfaithful(recording, recorded, 42);
  const auto elsewhere = find_unfaithful(recording, recorded, 42, "sense");

  ASSERT_TRUE(before.ok() && after.ok() && elsewhere.ok());
  EXPECT_FALSE(before->has_value());
  EXPECT_FALSE(elsewhere->has_value());
  // Drive moves as the changed command says, at tick 41; control is the one that is looked at
  // later.
  ASSERT_TRUE(after->has_value());
  EXPECT_EQ((*after)->component, "drive");
  EXPECT_EQ((*after)->first->tick, 41U);
}

TEST_F(Branch, CanBeCutShorter) {
  const RunRecording recording = open_recording(path_);

  const RunReport report =
      branch(recording, replay_plan(recording, changes({}, {}, 150)), 120, branch_path_);

  EXPECT_EQ(report.tally.truth->outcome, domain::Outcome::kTimeout);
  EXPECT_EQ(report.tally.truth->tick, 150U);
}

TEST_F(Branch, RefusesATickThatTheRunDoesNotHave) {
  const auto plan = replay_plan(open_recording(path_));
  const std::string ticks = std::to_string(last_tick_ + 1);

  EXPECT_EQ(refused(plan, last_tick_ + 1),
            path_ + ": the run ended at tick " + std::to_string(last_tick_));
  EXPECT_EQ(refused(plan, 5000),
            path_ + ": has " + ticks + " ticks; a branch at tick 5000 needs as many");
}

TEST_F(Branch, RefusesAnotherDurationOfATick) {
  const auto plan = replay_plan(open_recording(path_), changes({}, {"drive.tick_s=0.2"}));

  EXPECT_EQ(refused(plan, 50),
            path_ + ": has ticks of 0.3 s; a branch cannot go on with ticks of 0.2 s");
}

TEST_F(Branch, RefusesARecordingWithAGap) {
  RecordingDraft draft = RecordingDraft::read(path_);
  draft.drop(Topic::kTarget, 33, 33);
  draft.write(branch_path_);

  const RunRecording recording = open_recording(branch_path_);
  const auto start = branch_off(recording, replay_plan(recording), 50);

  ASSERT_FALSE(start.ok());
  EXPECT_EQ(start.error().text(), branch_path_ + ": lacks a sample of tick 33");
}

}  // namespace
}  // namespace clew::replay_test
