// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "../recording/scratch_directory.hpp"
#include "recorded_run.hpp"
#include "replay/component_replay.hpp"

namespace clew::replay_test {
namespace {

using namespace bridge;
using recording_test::ScratchDirectory;

class InsideAt : public testing::Test {
 protected:
  InsideAt() { record_run(plan_of("lagoudakis_maida", changes({}, {}, 44)), path_); }

  const ScratchDirectory scratch_;
  const std::string path_ = scratch_.file("run.mcap");
};

TEST_F(InsideAt, IsThatOfTheTickWithAllThatWentBefore) {
  const RunRecording recording = open_recording(path_);
  const runtime::RunPlan plan = replay_plan(recording);
  const auto commands = messages_of<domain::Command>(recording);

  for (const std::uint64_t tick : {0, 7, 42}) {
    const auto inside = inside_at(recording, plan, "control", tick);

    ASSERT_TRUE(inside.ok()) << inside.error().text();
    // What it shows as chosen is what it commanded then.
    ASSERT_EQ(inside->picture.charts.size(), 1U);
    EXPECT_EQ(inside->picture.charts[0].chosen_y, commands[tick].motion.speed_mps);
    EXPECT_EQ(inside->picture.charts[0].chosen_x, commands[tick].motion.turn_rate_radps);
  }
}

TEST_F(InsideAt, TellsADrivesCommandOfTheTickBefore) {
  const RunRecording recording = open_recording(path_);

  const auto first = inside_at(recording, replay_plan(recording), "drive", 0);
  const auto later = inside_at(recording, replay_plan(recording), "drive", 7);

  ASSERT_TRUE(first.ok() && later.ok());
  EXPECT_EQ(first->text.rfind("The robot stands at its start.", 0), 0U) << first->text;
  EXPECT_EQ(later->text.rfind("It was told to drive at ", 0), 0U) << later->text;
}

TEST_F(InsideAt, RefusesATickThatIsNotThere) {
  const RunRecording recording = open_recording(path_);

  const auto inside = inside_at(recording, replay_plan(recording), "control", 45);

  ASSERT_FALSE(inside.ok());
  EXPECT_EQ(inside.error().text(), path_ + ": has no tick 45; its last one is 44");
}

}  // namespace
}  // namespace clew::replay_test
