// SPDX-License-Identifier: Apache-2.0
/// Replay of runs of which not all is there: aborted ones, and real-time ones with late commands.
#include <gtest/gtest.h>

#include <set>

#include "../recording/scratch_directory.hpp"
#include "recorded_run.hpp"
#include "recorder/recording_sink.hpp"
#include "recording_draft.hpp"
#include "replay/component_replay.hpp"
#include "replay/resumption.hpp"

namespace clew::replay_test {
namespace {

using namespace bridge;
using domain::Topic;
using recording_test::ScratchDirectory;

constexpr std::uint64_t kLastTick = 120;

ReplayReport replayed(const RunRecording& recording, const std::string& stage,
                      const ReplayRange& range = {}) {
  const auto report = replay_component(recording, replay_plan(recording), stage, range);
  EXPECT_TRUE(report.ok()) << stage << ": " << report.error().text();
  return report.ok() ? *report : ReplayReport{};
}

std::string refused(const RunRecording& recording, const std::string& stage) {
  const auto report = replay_component(recording, replay_plan(recording), stage);
  return report.ok() ? "accepted" : report.error().text();
}

/// A recording of ticks 0 to 120, as a recorder leaves it that was told of each topic how far its
/// writer had come: classify to tick 90, recover to 94, control to 100, all others to the end.
class ReplayOfAnAbortedRun : public testing::Test {
 protected:
  void SetUp() override {
    record_run(plan_of("krishna_kalra", changes({}, {}, kLastTick)), whole_);
    draft_ = RecordingDraft::read(whole_);
    draft_.drop(Topic::kLandmark, 91, kLastTick);
    draft_.drop(Topic::kGuidance, 95, kLastTick);
    draft_.drop(Topic::kEvent, 95, kLastTick);
    draft_.drop(Topic::kCommand, 101, kLastTick);
    draft_.aborted = "interrupted by signal 2 (Interrupt)";
  }
  RunRecording recording() const {
    draft_.write(path_);
    return open_recording(path_);
  }

  ScratchDirectory scratch_;
  std::string whole_ = scratch_.file("whole.mcap");
  std::string path_ = scratch_.file("aborted.mcap");
  RecordingDraft draft_;
};

TEST_F(ReplayOfAnAbortedRun, GoesAsFarAsEachComponentHasItsInputsAndOutputs) {
  const RunRecording aborted = recording();
  const std::pair<const char*, std::uint64_t> expected[] = {
      {"drive", 102},    // the last command, of tick 100, is for tick 101
      {"sense", 121},    // from what drive wrote, all of which is there
      {"classify", 91},  // its own output ends with tick 90
      {"recover", 91},   // needs the landmarks
      {"control", 95}};  // needs the guidance

  for (const auto& [stage, ticks] : expected) {
    const ReplayReport report = replayed(aborted, stage);

    EXPECT_TRUE(report.identical()) << stage;
    EXPECT_EQ(report.ticks, ticks) << stage;
  }
}

TEST_F(ReplayOfAnAbortedRun, StillRefusesAGap) {
  draft_.drop(Topic::kScan, 30, 30);
  const RunRecording aborted = recording();

  EXPECT_EQ(refused(aborted, "control"),
            path_ + ": has no sample of 'scan' of tick 30, which control needs");
  const ReplayReport of_sense = replayed(aborted, "sense");
  ASSERT_FALSE(of_sense.identical());
  EXPECT_EQ(of_sense.first->tick, 30U);
}

TEST_F(ReplayOfAnAbortedRun, IsRefusedIfTheRunWasNotAborted) {
  draft_.aborted.clear();

  EXPECT_EQ(refused(recording(), "control"),
            path_ + ": has no sample of 'guidance' of tick 95, which control needs");
}

TEST_F(ReplayOfAnAbortedRun, TellsTheInsideOfATickThatTheComponentHas) {
  const RunRecording aborted = recording();
  const auto plan = replay_plan(aborted);

  EXPECT_TRUE(inside_at(aborted, plan, "recover", 90).ok());
  const auto later = inside_at(aborted, plan, "recover", 91);
  ASSERT_FALSE(later.ok());
  EXPECT_EQ(later.error().text(), path_ + ": has no tick 91; its last one is 90");
}

TEST_F(ReplayOfAnAbortedRun, GoesOnFromTheTicksThatAreWhole) {
  const RunRecording aborted = recording();

  const auto resumption = resume(aborted, replay_plan(aborted));

  ASSERT_TRUE(resumption.ok()) << resumption.error().text();
  EXPECT_EQ(resumption->processes.next_tick, 91U);
}

TEST_F(ReplayOfAnAbortedRun, RefusesALastTickThatNoTopicHas) {
  const RunRecording aborted = recording();

  EXPECT_TRUE(check_last_tick(aborted, kLastTick).ok());
  const auto beyond = check_last_tick(aborted, kLastTick + 1);
  ASSERT_FALSE(beyond.ok());
  EXPECT_EQ(beyond.error().text(), path_ + ": has no tick 121; its last one is 120");
}

/// What drive publishes when the command of some ticks does not come in time.
class LateRun {
 public:
  LateRun(const runtime::RunPlan& plan, std::set<std::uint64_t> without_command)
      : without_command_(std::move(without_command)) {
    for (const auto& stage : plan.graph.stages) {
      nodes_.push_back(std::move(runtime::make_node(plan, stage)).value());
    }
  }

  void record(std::uint64_t ticks, const runtime::RunPlan& plan, const std::string& path) {
    auto sink = RecordingSink::create(plan, path, false);
    ASSERT_TRUE(sink.ok()) << sink.error().text();
    for (std::uint64_t tick = 0; tick < ticks; ++tick) {
      for (runtime::Node& node : nodes_) {
        runtime::TopicSet present = node.ports().inputs;
        if (tick > 0 && without_command_.count(tick) == 0) present |= node.ports().delayed_inputs;
        node.step(tick, present, messages_);
      }
      for (Topic topic : domain::kAllTopics) {
        domain::visit_topic(topic, [&](auto constant) {
          constexpr auto kIndex = index_of(decltype(constant)::value);
          const auto& message = std::get<kIndex>(messages_);
          ASSERT_TRUE(
              (*sink)->add({topic, tick, tick, std::get<kIndex>(codecs_).encode(message)}).ok());
        });
      }
    }
    ASSERT_EQ((*sink)->close({}).failure, "");
  }

 private:
  std::set<std::uint64_t> without_command_;
  std::vector<runtime::Node> nodes_;
  domain::Messages messages_;
  Codecs codecs_;
};

TEST(ReplayOfARealTimeRun, GivesDriveNoCommandWhereItHadNone) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("late.mcap");
  const auto plan = plan_of("krishna_kalra", changes({}, {}, 30));
  LateRun(plan, {4, 5, 11}).record(30, plan, path);
  const RunRecording recording = open_recording(path);
  const auto states = messages_of<domain::State>(recording);
  ASSERT_TRUE(states[4].command_late && states[5].command_late && states[11].command_late);
  ASSERT_FALSE(states[6].command_late);

  const ReplayReport report = replayed(recording, "drive");

  EXPECT_TRUE(report.identical());
  EXPECT_EQ(report.ticks, 30U);
}

TEST(ReplayOfARealTimeRun, NoticesAStateThatSaysLateWhereTheRobotMoved) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("late.mcap");
  const auto plan = plan_of("krishna_kalra", changes({}, {}, 30));
  LateRun(plan, {}).record(30, plan, path);
  RecordingDraft draft = RecordingDraft::read(path);
  Codec<domain::State> codec;
  domain::State state;
  ASSERT_TRUE(codec.decode(draft.sample(Topic::kState, 7).cdr, state).ok());
  state.command_late = true;
  draft.sample(Topic::kState, 7).cdr = codec.encode(state);
  draft.write(path);
  const RunRecording recording = open_recording(path);

  const ReplayReport report = replayed(recording, "drive");

  // Without the command the robot stays: the odometry comes first in a tick.
  ASSERT_FALSE(report.identical());
  EXPECT_EQ(report.first->tick, 7U);
  EXPECT_EQ(report.first->topic, Topic::kOdometry);
  EXPECT_TRUE(report.inputs.empty());
}

TEST(ReplayOfARealTimeRun, DoesNotNeedACommandThatNeverCame) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("late.mcap");
  const auto plan = plan_of("krishna_kalra", changes({}, {}, 30));
  LateRun(plan, {4, 5, 11}).record(30, plan, path);
  RecordingDraft draft = RecordingDraft::read(path);
  // Those that ticks 4, 5 and 11 went on without; and the last one, which no tick is left to use.
  for (const std::uint64_t tick : {3, 4, 10, 29}) draft.drop(Topic::kCommand, tick, tick);
  draft.write(path);

  const ReplayReport report = replayed(open_recording(path), "drive");

  EXPECT_TRUE(report.identical());
  EXPECT_EQ(report.ticks, 30U);
}

TEST(ReplayOfARealTimeRun, GoesOnAfterTheLastCommandOfAFrozenControl) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("late.mcap");
  const auto plan = plan_of("krishna_kalra", changes({}, {}, 12));
  LateRun(plan, {6, 7, 8, 9, 10, 11}).record(12, plan, path);
  RecordingDraft draft = RecordingDraft::read(path);
  draft.drop(Topic::kCommand, 5, 11);
  draft.aborted = "control was killed";
  draft.write(path);
  const RunRecording recording = open_recording(path);

  EXPECT_EQ(replayed(recording, "drive").ticks, 12U);
  EXPECT_TRUE(replayed(recording, "drive").identical());
  EXPECT_EQ(replayed(recording, "control").ticks, 5U);
}

TEST(ReplayOfARealTimeRun, RefusesARecordingThatLacksACommandThatWasInTime) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("late.mcap");
  const auto plan = plan_of("krishna_kalra", changes({}, {}, 30));
  LateRun(plan, {4, 5, 11}).record(30, plan, path);
  RecordingDraft draft = RecordingDraft::read(path);
  draft.drop(Topic::kCommand, 5, 5);
  draft.write(path);

  EXPECT_EQ(refused(open_recording(path), "drive"),
            path + ": has no sample of 'command' of tick 5, which drive needs");
}

TEST(ReplayOfARealTimeRun, TakesAStateOutsideItsRangeForADifference) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("late.mcap");
  const auto plan = plan_of("krishna_kalra", changes({}, {}, 30));
  LateRun(plan, {}).record(30, plan, path);
  RecordingDraft draft = RecordingDraft::read(path);
  // Before the path's length: the header, the stamp, the pose and two speeds. Its sign.
  char& sign = draft.sample(Topic::kState, 7).cdr[4 + 24 + 24 + 16 + 7];
  sign = static_cast<char>(sign ^ 0x80);
  draft.write(path);

  const ReplayReport report = replayed(open_recording(path), "drive");

  ASSERT_FALSE(report.identical());
  EXPECT_EQ(report.first->tick, 7U);
  EXPECT_EQ(report.first->fields[0].path, "path_length_m");
  EXPECT_EQ(report.different_ticks, 1U);
}

}  // namespace
}  // namespace clew::replay_test
