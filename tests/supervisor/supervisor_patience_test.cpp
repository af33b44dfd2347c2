// SPDX-License-Identifier: Apache-2.0
/// How long a supervisor waits, and for whom: steps that take long, processes that are stuck, and
/// machines that are busy.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "component/scan_watch.hpp"
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

TEST_F(Patience, WaitsForAProcessThatComesBackAsLongAsItGetsOn) {
  all_join();
  all_report(5);
  supervisor_->turn(now_);
  peers_.erase("sense");
  kill("sense");
  activity_ = ProcessActivity{};
  activity_->runnable = true;

  pass(3 * kStallTimeout, {"sense"});
  EXPECT_FALSE(supervisor_->over());
  activity_->runnable = false;
  pass(kStallTimeout + seconds(1), {"sense"});

  EXPECT_EQ(aborted().rfind("no tick was completed for 10 s", 0), 0u);
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
  now_ += kPatienceOfPerson - kStallTimeout;
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

/// In real time, under way.
class RunInRealTime : public SupervisedRun {
 protected:
  void begin_as(const std::string& name) {
    layout_.pace = Pace::kRealtime;
    layout_.name = name;
    TearDown();
    begin();
    all_join();
  }
  void tell(const char* kind) {
    peer("control").say(FrameType::kIncident, domain::Incident{0, kind, "control", "so it is"});
    supervisor_->turn(now_);
  }
  std::size_t rests() { return peer("drive").take(FrameType::kRest).size(); }
  /// What drive was told of its speed since the last call: `slow fast `.
  std::string speeds() {
    std::string told;
    for (const Frame& frame : peer("drive").take(FrameType::kSlow)) {
      told += frame.as<Slow>()->slowly ? "slow " : "fast ";
    }
    return told;
  }
};

TEST_F(RunInRealTime, GoesSlowlyWhileTheSensorIsStale) {
  begin_as("");

  tell(ScanWatch::kStale);
  tell(ScanWatch::kFresh);

  EXPECT_EQ(speeds(), "slow fast ");
  EXPECT_EQ(rests(), 0u);
  EXPECT_TRUE(logged("so it is; the robot goes half as fast"));
}

TEST_F(RunInRealTime, RestsForGoodOnceTheSensorWasGoneUnlessSomebodySaysResume) {
  begin_as("robot");

  tell(ScanWatch::kGone);
  tell(ScanWatch::kFresh);
  pass(2 * kRealtimeFrozenAfter);

  EXPECT_EQ(rests(), 1u);
  EXPECT_FALSE(supervisor_->over());
  EXPECT_TRUE(peer("drive").take(FrameType::kRelease).empty());
  EXPECT_TRUE(logged("so it is; the robot rests until 'clew resume robot'"));
}

TEST_F(RunInRealTime, EndsAtRestAfterItsSensorWasGoneIfNobodyCanSayResume) {
  begin_as("");

  tell(ScanWatch::kGone);
  pass(kRealtimeFrozenAfter - milliseconds(200));
  EXPECT_FALSE(supervisor_->over()) << "a process that is stopped is named first";
  EXPECT_EQ(rests(), 1u) << "but the robot rests at once";
  pass(seconds(1));

  EXPECT_EQ(aborted(), "so it is; a run without a name cannot be told to go on");
}

TEST_F(SupervisedRun, TellsOfTheSensorInLockstepAndGoesOn) {
  all_join();

  peer("control").say(FrameType::kIncident,
                      domain::Incident{0, ScanWatch::kFrozen, "control", "so it is"});
  pass(seconds(3));

  EXPECT_FALSE(supervisor_->over());
  EXPECT_TRUE(peer("drive").take(FrameType::kRest).empty());
  EXPECT_TRUE(logged("so it is"));
}

}  // namespace
}  // namespace clew::bridge
