// SPDX-License-Identifier: Apache-2.0
#include "replay/branch.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "../recording/scratch_directory.hpp"
#include "recorded_run.hpp"
#include "recorder/recording_sink.hpp"
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

  /// Runs `plan` from `tick` on and records it, with a note of where it began if it is another one;
  /// the report.
  RunReport branch(const RunRecording& recording, runtime::RunPlan plan, std::uint64_t tick,
                   const std::string& path) {
    const auto recorded = replay_plan(recording);
    auto start = branch_off(recording, recorded, plan, tick);
    EXPECT_TRUE(start.ok()) << start.error().text();
    if (plan.bundle != recorded.bundle) {
      note_branch(recording.description().bundle, robot_of(*start), plan);
    }
    auto sink = RecordingSink::create(plan, path, true);
    EXPECT_TRUE(sink.ok()) << sink.error().text();
    const auto copied = copy_samples_before(recording, tick, **sink);
    EXPECT_TRUE(copied.ok()) << copied.error().text();
    auto report = run_composed(plan, std::move(start).value(), {}, sink->get(), {});
    EXPECT_TRUE(report.ok()) << report.error().text();
    EXPECT_EQ((*sink)->close({}).failure, "");
    return std::move(report).value();
  }

  std::string refused(const runtime::RunPlan& plan, std::uint64_t tick) {
    const RunRecording recording = open_recording(path_);
    const auto start = branch_off(recording, replay_plan(recording), plan, tick);
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
    EXPECT_EQ(report.statistics.truth->tick, last_tick_);
    EXPECT_EQ(report.statistics.traps_detected, 1U) << "those before the branch count";
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
      if (tick == branch_tick) place_robot();
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
  /// The new robot begins where the old one stands.
  void place_robot() {
    for (std::size_t i = 0; i < before_.size(); ++i) {
      if (before_[i].name() != "drive") continue;
      ASSERT_TRUE(after_[i].load(before_[i].save()).ok());
    }
  }
  static void step(runtime::Node& node, std::uint64_t tick, domain::Messages& messages) {
    runtime::TopicSet present = node.ports().inputs;
    if (tick > 0) present |= node.ports().delayed_inputs;
    node.step(tick, present, messages);
  }
  std::string encode(Topic topic) {
    return domain::visit_topic(topic, [&](auto constant) {
      constexpr auto kIndex = index_of(decltype(constant)::value);
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

TEST_F(Branch, BeginsWhereTheRobotStands) {
  const RunRecording recording = open_recording(path_);
  // A drive that is slower from tick 60 on; by the recorded commands alone it would stand
  // elsewhere.
  branch(recording, replay_plan(recording, changes({}, {"drive.max_step_m=0.1"}, kMaxTicks)), 60,
         branch_path_);

  const auto before = messages_of<domain::Odometry>(recording);
  const auto after = messages_of<domain::Odometry>(open_recording(branch_path_));

  ASSERT_GT(before[60].travel_m - before[59].travel_m, 0.1);
  // The command of tick 59 is applied at the start of tick 60, which is the new drive's.
  EXPECT_EQ(after[59].travel_m, before[59].travel_m);
  EXPECT_DOUBLE_EQ(after[60].travel_m, before[59].travel_m + 0.1);
}

TEST_F(Branch, SaysInItsRecordingWhereItBeganAndOfWhat) {
  const RunRecording recording = open_recording(path_);
  branch(recording, replay_plan(recording, changes({}, {"drive.max_step_m=0.1"}, kMaxTicks)), 60,
         branch_path_);
  const RunRecording branched = open_recording(branch_path_);

  const auto place = branch_of(branched);

  ASSERT_TRUE(place.ok() && place->has_value());
  EXPECT_EQ((*place)->tick, 60U);
  EXPECT_FALSE(branch_of(recording)->has_value());
  const auto& bundle = branched.description().bundle;
  EXPECT_EQ(bundle.at("before_branch/graph.yaml"), recording.description().bundle.at("graph.yaml"));
  EXPECT_EQ(bundle.count("before_branch/world.yaml"), 0U) << "it is the same";
}

TEST_F(Branch, IsReplayedFromWhereItBegan) {
  const RunRecording recording = open_recording(path_);
  const auto change =
      changes({"recover.detector=none"}, {"drive.max_step_m=0.1", "sense.range_m=1.2"}, kMaxTicks);
  branch(recording, replay_plan(recording, change), 60, branch_path_);
  const RunRecording branched = open_recording(branch_path_);
  const auto own_plan = recorded_plan(branched, stages::all());
  ASSERT_TRUE(own_plan.ok()) << own_plan.error().text();

  for (const auto& stage : own_plan->graph.stages) {
    const auto replayed = replay_component(branched, *own_plan, stage.info->name, {60});

    ASSERT_TRUE(replayed.ok()) << replayed.error().text();
    EXPECT_TRUE(replayed->identical()) << stage.info->name;
  }
}

TEST_F(Branch, CanBranchAgain) {
  const RunRecording recording = open_recording(path_);
  branch(recording, replay_plan(recording, changes({}, {"drive.max_step_m=0.1"}, kMaxTicks)), 60,
         branch_path_);
  const RunRecording branched = open_recording(branch_path_);
  const std::string second_path = scratch_.file("second.mcap");

  branch(branched, replay_plan(branched, changes({"recover.detector=none"}, {}, kMaxTicks)), 90,
         second_path);

  const RunRecording second = open_recording(second_path);
  const auto diff = diff_recordings(branched, second);
  ASSERT_TRUE(diff.ok()) << diff.error().text();
  EXPECT_TRUE(diff->identical() || diff->first->tick >= 90);
  const auto own_plan = recorded_plan(second, stages::all());
  for (const auto& stage : own_plan->graph.stages) {
    const auto replayed = replay_component(second, *own_plan, stage.info->name, {90});
    ASSERT_TRUE(replayed.ok()) << replayed.error().text();
    EXPECT_TRUE(replayed->identical()) << stage.info->name;
  }
  const auto plan = replay_plan(branched);
  const auto too_early = branch_off(branched, plan, plan, 59);
  ASSERT_FALSE(too_early.ok());
  EXPECT_NE(too_early.error().message.find("is a branch itself, at tick 60"), std::string::npos);
}

TEST_F(Branch, RefusesANoteThatIsNone) {
  RecordingDraft draft = RecordingDraft::read(path_);
  for (const auto& [note, message] :
       std::map<std::string, std::string>{{"drive: x00\n", "tick"},
                                          {"tick: -1\ndrive: x00\n", "negative"},
                                          {"tick: 5\ndrive: x0\n", "no state of drive"},
                                          {"tick: 5\ndrive: x0g\n", "no state of drive"}}) {
    draft.description.bundle["branch.yaml"] = note;
    draft.write(branch_path_);

    const auto place = branch_of(open_recording(branch_path_));

    ASSERT_FALSE(place.ok()) << note;
    EXPECT_NE(place.error().text().find(message), std::string::npos) << place.error().text();
  }
  draft.description.bundle["branch.yaml"] = "tick: 5\ndrive: x00\n";
  draft.write(branch_path_);
  const RunRecording recording = open_recording(branch_path_);

  const auto replayed = replay_component(recording, replay_plan(recording), "drive");

  ASSERT_FALSE(replayed.ok());
  EXPECT_NE(replayed.error().text().find("the saved state of drive is not one of this component"),
            std::string::npos)
      << replayed.error().text();
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

  EXPECT_EQ(report.statistics.truth->outcome, domain::Outcome::kTimeout);
  EXPECT_EQ(report.statistics.truth->tick, 150U);
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
  const auto start = branch_off(recording, replay_plan(recording), replay_plan(recording), 50);

  ASSERT_FALSE(start.ok());
  EXPECT_EQ(start.error().text(), branch_path_ + ": lacks a sample of tick 33");
}

}  // namespace
}  // namespace clew::replay_test
