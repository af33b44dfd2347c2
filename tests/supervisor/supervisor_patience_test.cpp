// SPDX-License-Identifier: Apache-2.0
/// How long a supervisor waits, and for whom: steps that take long, processes that are stuck, and
/// machines that are busy.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "supervised_run.hpp"

namespace clew::bridge {
namespace {

using Patience = SupervisedRun;

TEST_F(Patience, AnswersAStallByStartingAllAnewAndThenByTheEnd) {
  all_join();
  all_report(5);
  supervisor_->turn(now_);
  std::map<std::string, int> before;
  for (const std::string& stage : kStages) before[stage] = member(stage).child->process_id();

  pass(kStallRestart + milliseconds(100));
  EXPECT_TRUE(logged("no tick was completed for 5 s, though all report; restarting all"));
  // Their processes end, and others are started.
  for (const std::string& stage : kStages) kill(stage);
  peers_.clear();
  supervisor_->turn(now_);
  supervisor_->turn(now_);
  for (const std::string& stage : kStages) {
    EXPECT_NE(member(stage).child->process_id(), before[stage]) << stage;
  }

  // They come to the same tick, and stand still again.
  all_join();
  all_report(5);
  pass(kStallTimeout + seconds(2));
  EXPECT_EQ(aborted(), "no tick was completed for 10 s; ticks done: drive 5 sense 5 control 5");
}

TEST_F(Patience, WaitsForAStepAsLongAsItGetsProcessorTime) {
  all_join();
  all_report(5);
  supervisor_->turn(now_);
  busy_ = true;
  nanoseconds_per_beat_ = 1;

  pass(kStallTimeout + seconds(5));
  EXPECT_TRUE(log_.empty());
  pass(10 * kLongestStep);
  EXPECT_FALSE(supervisor_->over());
  EXPECT_TRUE(logged(
      "control has been busy with one tick for 60 s; ticks done: drive 5 sense 5 control 5"));

  // It ends, and the others have still to do theirs.
  busy_ = false;
  pass(seconds(1));
  all_report(6);
  pass(seconds(1));
  EXPECT_FALSE(supervisor_->over());
  EXPECT_FALSE(logged("restarting"));
}

TEST_F(Patience, EndsWhenAStepHasHadNoProcessorTimeForAMinute) {
  all_join();
  all_report(5);
  supervisor_->turn(now_);
  busy_ = true;

  pass(kLongestStep - seconds(1));
  EXPECT_FALSE(supervisor_->over());
  pass(seconds(2));

  EXPECT_EQ(aborted(), "no tick was completed for 60 s; ticks done: drive 5 sense 5 control 5");
}

TEST_F(Patience, HasMorePatienceOnAMachineThatIsLateWithHeartbeats) {
  constexpr auto kLate = 7 * kHeartbeatPeriod;
  static_assert(kLate < kFrozenAfter);
  all_join();
  all_report(5);
  supervisor_->turn(now_);

  pass(3 * kStallRestart, {}, kLate);
  EXPECT_TRUE(log_.empty()) << "a third of the heartbeats that count as five seconds";
  pass(kStallRestart, {}, kLate);

  EXPECT_TRUE(logged("though all report; restarting all"));
}

TEST_F(Patience, EndsWhenAProcessThatAPersonStartedStaysSilent) {
  layout_.external = {"sense"};
  TearDown();
  begin();
  all_join();
  all_report(5);
  supervisor_->turn(now_);

  pass(kStallTimeout, {"sense"});
  EXPECT_TRUE(logged("sense (process 1) has not reported for 10 s; the run waits for it, 3600 s"));
  const std::size_t lines = log_.size();
  now_ += kPatience - kStallTimeout;
  all_live({"sense"});
  supervisor_->turn(now_);
  EXPECT_FALSE(supervisor_->over());
  EXPECT_EQ(log_.size(), lines) << "it is told once";
  now_ += seconds(1);
  supervisor_->turn(now_);

  EXPECT_EQ(aborted(), "no tick was completed for 3600 s; ticks done: drive 5 sense 5 control 5");
}

TEST_F(Patience, AccusesNobodyAfterItWasAwayItself) {
  all_join();
  all_report(1);
  supervisor_->turn(now_);

  now_ += 30 * kFrozenAfter;
  supervisor_->turn(now_);
  EXPECT_TRUE(log_.empty());
  pass(kFrozenAfter, {"sense"});

  EXPECT_TRUE(logged("does not report; killing it")) << "who stays silent is frozen";
}

}  // namespace
}  // namespace clew::bridge
