// SPDX-License-Identifier: Apache-2.0
/// What `clew train neuro-fuzzy` takes from recordings, also from those that no recorder writes.
#include "train/training_groups.hpp"

#include <gtest/gtest.h>

#include "tests/recording/scratch_directory.hpp"
#include "tests/replay/recorded_run.hpp"
#include "tests/replay/recording_draft.hpp"

namespace clew::train {
namespace {

using domain::Topic;
using replay_test::RecordingDraft;

constexpr std::uint64_t kTicks = 30;

/// The answer to a recording of figure 8's room that lacks a topic.
core::Result<train::ShownGroups> groups_without(const std::optional<Topic>& topic) {
  const recording_test::ScratchDirectory directory;
  const std::string file = directory.file("run.mcap");
  replay_test::record_run(
      replay_test::plan_of("wang_yang_meng", replay_test::changes({}, {}, kTicks)), file);
  RecordingDraft draft = RecordingDraft::read(file);
  if (topic) {
    draft.description.schemas.erase(*topic);
    draft.drop(*topic, 0, kTicks);
  }
  draft.write(file);
  return train::groups_of_recording({}, file);
}

/// The end of a refusal, after the file's name.
std::string refusal_without(Topic topic) {
  const auto groups = groups_without(topic);
  return groups.ok() ? "accepted" : groups.error().message;
}

TEST(TrainingGroups, AreOneATickOfAWholeRecording) {
  const auto groups = groups_without(std::nullopt);

  ASSERT_TRUE(groups.ok()) << groups.error().text();
  EXPECT_EQ(groups->groups.size(), kTicks + 1);
}

TEST(TrainingGroups, RefuseARecordingWithoutScansOrCommands) {
  EXPECT_EQ(refusal_without(Topic::kScan), "has no scan; training needs scan and command");
  EXPECT_EQ(refusal_without(Topic::kCommand), "has no command; training needs scan and command");
}

}  // namespace
}  // namespace clew::train
