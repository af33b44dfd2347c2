// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "../recording/scratch_directory.hpp"
#include "recorded_run.hpp"
#include "replay/component_replay.hpp"

namespace clew::replay_test {
namespace {

using namespace bridge;
using recording_test::ScratchDirectory;

/// A recording of a behaviour that shows its inside.
class PictureAt : public testing::Test {
 protected:
  PictureAt() { record_run(plan_of("lagoudakis_maida", changes({}, {}, 60)), path_); }

  const ScratchDirectory scratch_;
  const std::string path_ = scratch_.file("run.mcap");
};

TEST_F(PictureAt, IsThatOfTheTickWithAllThatWentBefore) {
  const RunRecording recording = open_recording(path_);
  const runtime::RunPlan plan = replay_plan(recording);
  const auto commands = messages_of<domain::Command>(recording);

  for (const std::uint64_t tick : {0, 7, 42}) {
    const auto picture = picture_at(recording, plan, "control", tick);

    ASSERT_TRUE(picture.ok()) << picture.error().text();
    // What it shows as chosen is what it commanded then.
    ASSERT_EQ(picture->charts.size(), 1U);
    EXPECT_EQ(picture->charts[0].chosen_y, commands[tick].motion.speed_mps);
    EXPECT_EQ(picture->charts[0].chosen_x, commands[tick].motion.turn_rate_radps);
  }
}

TEST_F(PictureAt, IsEmptyOfComponentsThatShowNothing) {
  const RunRecording recording = open_recording(path_);

  const auto picture = picture_at(recording, replay_plan(recording), "sense", 5);

  ASSERT_TRUE(picture.ok()) << picture.error().text();
  EXPECT_TRUE(picture->empty());
}

TEST_F(PictureAt, RefusesATickThatIsNotThere) {
  const RunRecording recording = open_recording(path_);

  const auto picture = picture_at(recording, replay_plan(recording), "control", 61);

  ASSERT_FALSE(picture.ok());
  EXPECT_EQ(picture.error().text(), path_ + ": has no tick 61; its last one is 60");
}

}  // namespace
}  // namespace clew::replay_test
