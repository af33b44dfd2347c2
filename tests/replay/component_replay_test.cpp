// SPDX-License-Identifier: Apache-2.0
#include "replay/component_replay.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "../recording/scratch_directory.hpp"
#include "every_behaviour.hpp"
#include "recorded_run.hpp"
#include "recorder/recording_sink.hpp"
#include "recording_draft.hpp"
#include "replay/recorded_plan.hpp"
#include "stages/all.hpp"
#include "tests/source_path.hpp"

namespace clew::replay_test {
namespace {

using namespace bridge;
using domain::Topic;
using recording_test::ScratchDirectory;

constexpr std::uint64_t kTicks = 400;  // enough for u-trap's trap, at tick 112, and the way out

ReplayReport replayed(const RunRecording& recording, const runtime::RunPlan& plan,
                      const std::string& stage, const ReplayRange& range = {}) {
  const auto report = replay_component(recording, plan, stage, range);
  EXPECT_TRUE(report.ok()) << stage << ": " << report.error().text();
  return report.ok() ? *report : ReplayReport{};
}

std::string refused(const RunRecording& recording, const runtime::RunPlan& plan,
                    const std::string& stage, const ReplayRange& range = {}) {
  const auto report = replay_component(recording, plan, stage, range);
  return report.ok() ? "accepted" : report.error().text();
}

class ReplayOfBehaviour : public testing::TestWithParam<Behaviour> {};

TEST_P(ReplayOfBehaviour, IsIdenticalToItsOwnRecording) {
  const ScratchDirectory scratch;
  const auto plan = plan_with(GetParam(), kTicks);
  ASSERT_TRUE(plan.has_value()) << "no shipped graph fits";
  record_run(*plan, scratch.file("run.mcap"));
  const RunRecording recording = open_recording(scratch.file("run.mcap"));
  const auto recorded = recorded_plan(recording, stages::all());
  ASSERT_TRUE(recorded.ok()) << recorded.error().text();

  for (const auto& stage : recorded->graph.stages) {
    const ReplayReport report = replayed(recording, *recorded, stage.info->name);

    EXPECT_TRUE(report.identical()) << stage.info->name;
    EXPECT_EQ(report.ticks, recording.end()->ticks);
    EXPECT_EQ(report.different_ticks, 0U);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ReplayOfBehaviour, testing::ValuesIn(all_behaviours()),
                         [](const auto& instance) {
                           const Behaviour& behaviour = instance.param;
                           return behaviour.stage + '_' + behaviour.part + '_' + behaviour.name;
                         });

/// The recording of a whole run through the u-trap.
class ComponentReplay : public testing::Test {
 protected:
  void SetUp() override {
    record_run(plan_of("krishna_kalra", changes({}, {}, kTicks)), path_);
    draft_ = RecordingDraft::read(path_);
  }
  RunRecording recording() const { return open_recording(path_); }
  /// The recording with the draft's changes.
  RunRecording changed() const {
    draft_.write(changed_path_);
    return open_recording(changed_path_);
  }
  runtime::RunPlan plan() const { return replay_plan(recording()); }

  ScratchDirectory scratch_;
  std::string path_ = scratch_.file("run.mcap");
  std::string changed_path_ = scratch_.file("changed.mcap");
  RecordingDraft draft_;
};

TEST_F(ComponentReplay, GoesOnWithRecordedInputsAfterADifference) {
  // The recorded command of tick 20 is not what control wrote: that tick differs, and no other.
  draft_.sample(Topic::kCommand, 20).cdr = draft_.sample(Topic::kCommand, 90).cdr;

  const ReplayReport report = replayed(changed(), plan(), "control");

  ASSERT_FALSE(report.identical());
  EXPECT_EQ(report.first->tick, 20U);
  EXPECT_EQ(report.first->fields[0].path, "stamp.tick");
  EXPECT_EQ(report.first->fields[0].a, FieldValue(std::uint64_t{90}));
  EXPECT_EQ(report.first->fields[0].b, FieldValue(std::uint64_t{20}));
  EXPECT_EQ(report.different_ticks, 1U);
}

TEST_F(ComponentReplay, TellsTheInputsOfTheFirstDifference) {
  draft_.sample(Topic::kCommand, 20).cdr = draft_.sample(Topic::kCommand, 90).cdr;

  const ReplayReport report = replayed(changed(), plan(), "control");

  // Control reads guidance, odometry and scan here; target only without guidance.
  ASSERT_EQ(report.inputs.size(), 3U);
  EXPECT_EQ(report.inputs[0].topic, Topic::kGuidance);
  EXPECT_EQ(report.inputs[1].topic, Topic::kOdometry);
  EXPECT_EQ(report.inputs[2].topic, Topic::kScan);
  const auto odometry = messages_of<domain::Odometry>(recording())[20];
  const std::vector<Field> expected = fields_of(odometry);
  ASSERT_EQ(report.inputs[1].fields.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(report.inputs[1].fields[i].path, expected[i].path);
    EXPECT_TRUE(same_bits(report.inputs[1].fields[i].value, expected[i].value));
  }
}

TEST_F(ComponentReplay, ComparesOnlyTheRangeAskedForButFeedsAllBefore) {
  draft_.sample(Topic::kEvent, 20).cdr.back() ^= 1;
  draft_.sample(Topic::kEvent, 150).cdr.back() ^= 1;
  const RunRecording with_changes = changed();

  const ReplayReport between = replayed(with_changes, plan(), "recover", {21, 149});
  const ReplayReport after = replayed(with_changes, plan(), "recover", {21, 160});
  const ReplayReport before = replayed(with_changes, plan(), "recover", {0, 20});

  // The memory of the ticks before 21 is needed to notice the trap at tick 112.
  EXPECT_TRUE(between.identical());
  EXPECT_EQ(between.ticks, 129U);
  EXPECT_EQ(after.first->tick, 150U);
  EXPECT_EQ(before.first->tick, 20U);
  EXPECT_EQ(before.ticks, 21U);
}

TEST_F(ComponentReplay, IsHeldToARateOnRequest) {
  ReplayRange range;
  range.last_tick = 5;
  range.rate = 100.0;

  const ReplayReport report = replayed(recording(), plan(), "sense", range);

  // Ticks of 0.3 s at 100 times: at most one in 3 ms, and the first one at once.
  EXPECT_TRUE(report.identical());
  EXPECT_LE(report.ticks_per_s, 6.0 / (5 * 0.003));
}

TEST_F(ComponentReplay, CountsAMissingOutputAsADifference) {
  draft_.drop(Topic::kScan, 30, 30);

  const ReplayReport report = replayed(changed(), plan(), "sense");

  ASSERT_FALSE(report.identical());
  EXPECT_EQ(report.first->tick, 30U);
  EXPECT_EQ(report.first->fields[0].path, "(sample)");
  EXPECT_FALSE(report.first->fields[0].a.has_value());
}

TEST_F(ComponentReplay, RefusesARecordingThatLacksAnInput) {
  draft_.drop(Topic::kScan, 30, 30);

  EXPECT_EQ(refused(changed(), plan(), "control"),
            changed_path_ + ": has no sample of 'scan' of tick 30, which control needs");
}

TEST_F(ComponentReplay, RefusesARecordingThatBeginsLater) {
  for (Topic topic : domain::kAllTopics) draft_.drop(topic, 0, 9);

  EXPECT_EQ(refused(changed(), plan(), "control"),
            changed_path_ + ": has no sample of tick 0 for control; the next is of tick 10");
}

TEST_F(ComponentReplay, RefusesARecordingWithoutATopicItNeeds) {
  draft_.drop(Topic::kGuidance, 0, kTicks);
  draft_.description.schemas.erase(Topic::kGuidance);
  const RunRecording without = changed();

  EXPECT_EQ(refused(without, plan(), "control"),
            changed_path_ + ": has no topic 'guidance', without which control cannot be replayed");
  EXPECT_EQ(refused(without, plan(), "recover"),
            changed_path_ + ": has no topic 'guidance', without which recover cannot be replayed");
  EXPECT_TRUE(replayed(without, plan(), "sense").identical());
}

TEST_F(ComponentReplay, RefusesASampleThatIsNoMessage) {
  draft_.sample(Topic::kScan, 8).cdr.resize(20);

  const std::string message = refused(changed(), plan(), "control");

  EXPECT_EQ(message.find(changed_path_ + ": holds a bad sample of 'scan' of tick 8: "), 0U)
      << message;
}

TEST_F(ComponentReplay, RefusesAStageThatIsNotThere) {
  EXPECT_NE(refused(recording(), plan(), "contrl").find("did you mean 'control'?"),
            std::string::npos);
}

TEST_F(ComponentReplay, RefusesARangeWithoutATick) {
  EXPECT_EQ(refused(recording(), plan(), "control", {5, 4}), "no tick is from 5 to 4");
  const auto ticks = std::to_string(recording().end()->ticks);
  EXPECT_EQ(refused(recording(), plan(), "control", {5000, 6000}),
            path_ + ": has no tick from 5000 on; it has " + ticks);
}

TEST_F(ComponentReplay, GoesUpToTheTearOfATornRecording) {
  const std::string bytes = recording_test::read_bytes(path_);
  const std::string torn = scratch_.file("torn.mcap");
  for (const std::size_t share : {3, 5, 7, 9}) {
    recording_test::write_bytes(torn, bytes.substr(0, bytes.size() * share / 10));
    const RunRecording recording = open_recording(torn);
    ASSERT_FALSE(recording.complete());

    for (const char* stage : {"drive", "sense", "classify", "recover", "control"}) {
      const ReplayReport report = replayed(recording, plan(), stage);

      EXPECT_TRUE(report.identical()) << stage;
      EXPECT_GT(report.ticks, 10U);
      EXPECT_LT(report.ticks, kTicks);
    }
  }
}

TEST_F(ComponentReplay, LeavesTheLastTickOfATornRecordingOutIfItIsNotWhole) {
  // What a recorder leaves that dies between the samples of a tick.
  draft_.samples.erase(draft_.samples.begin() + 8 * 100 + 3, draft_.samples.end());
  draft_.finished = false;
  const RunRecording recording = changed();

  const ReplayReport report = replayed(recording, plan(), "control");

  EXPECT_TRUE(report.identical());
  EXPECT_EQ(report.ticks, 100U);
}

TEST_F(ComponentReplay, RefusesMessageTypesOfAnotherVersion) {
  draft_.description.idl_fingerprint = "00112233445566778899aabbccddeeff";
  const RunRecording foreign = changed();

  for (const auto& plan : {recorded_plan(foreign, stages::all()),
                           changed_plan(foreign, {}, shipped_configs(), stages::all())}) {
    ASSERT_FALSE(plan.ok());
    EXPECT_NE(plan.error().text().find("was recorded with other message types"), std::string::npos);
  }
}

TEST_F(ComponentReplay, RefusesARecordingThatLacksAFileOfItsRun) {
  draft_.description.bundle.erase("rulebases/krishna_kalra_control.yaml");

  const auto plan = recorded_plan(changed(), stages::all());

  ASSERT_FALSE(plan.ok());
  const std::string text = plan.error().text();
  EXPECT_EQ(text.find(changed_path_ + ": graph.yaml:"), 0u) << text;
  EXPECT_NE(text.find(": the bundle has no rulebases/krishna_kalra_control.yaml"),
            std::string::npos)
      << text;
}

TEST_F(ComponentReplay, TakesFilesThatOnlyAChangeNeedsFromTheConfiguration) {
  record_run(plan_of("reactive", changes({}, {}, 20)), scratch_.file("reactive.mcap"));
  const RunRecording reactive = open_recording(scratch_.file("reactive.mcap"));
  const std::string rules = scratch_.file("other.yaml");
  std::filesystem::copy(tests::source_path("configs/rulebases/krishna_kalra_control.yaml"), rules);

  const auto plan = replay_plan(reactive, changes({}, {"control.rules=" + rules}));

  EXPECT_TRUE(replayed(reactive, plan, "control").identical());
}

TEST_F(ComponentReplay, RefusesAComponentOfSomeoneElse) {
  std::string& graph = draft_.description.bundle["graph.yaml"];
  const std::size_t control = graph.find("control:\n");
  ASSERT_NE(control, std::string::npos);
  graph.replace(control, std::string::npos, "control:\n  exec: [./theirs]\n");
  const RunRecording recording = changed();

  EXPECT_EQ(refused(recording, replay_plan(recording), "control"),
            "control is a third-party component: --publish feeds it what was recorded and "
            "compares what it writes, --start starts it for that");
  EXPECT_TRUE(replayed(recording, replay_plan(recording), "sense").identical());
}

}  // namespace
}  // namespace clew::replay_test
