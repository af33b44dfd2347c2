// SPDX-License-Identifier: Apache-2.0
/// What becomes of a run, decided by a supervisor whose clock is a number and whose components are
/// this test at the other ends of their lines.
#include <gtest/gtest.h>

#include <csignal>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "run/run_control.hpp"
#include "run/run_page.hpp"
#include "runtime/config_source.hpp"
#include "runtime/intervention.hpp"
#include "supervised_run.hpp"

namespace clew::bridge {
namespace {

TEST_F(SupervisedRun, BeginsWhenEverybodyHasFoundTheOthers) {
  join("drive").say(FrameType::kWaiting, Waiting{});
  join("sense").say(FrameType::kWaiting, Waiting{});
  join("control").say(FrameType::kWaiting, Waiting{{"control has not found something"}});
  supervisor_->turn(now_);
  EXPECT_TRUE(peer("drive").take(FrameType::kGo).empty());

  peer("control").say(FrameType::kWaiting, Waiting{});
  supervisor_->turn(now_);

  EXPECT_EQ(peer("drive").take(FrameType::kGo).size(), 1u);
  EXPECT_TRUE(peer("sense").take(FrameType::kGo).empty()) << "only drive starts ticks";
}

TEST_F(SupervisedRun, TellsTheWorldOnlyToWhoMayKnowIt) {
  all_join();

  const auto drive = peer("drive").take(FrameType::kAssignment);
  const auto control = peer("control").take(FrameType::kAssignment);

  EXPECT_EQ(drive.at(0).as<Assignment>()->bundle.count("world.yaml"), 1u);
  EXPECT_EQ(control.at(0).as<Assignment>()->bundle.count("world.yaml"), 0u);
  EXPECT_EQ(control.at(0).as<Assignment>()->bundle.count("graph.yaml"), 1u);
}

TEST_F(SupervisedRun, IsAbortedWhenTheStartTakesTooLongAndNamesWhoIsMissing) {
  join("drive");
  join("sense").say(FrameType::kWaiting, Waiting{{"sense has not found the reader of 'scan'"}});

  pass(seconds(11));

  EXPECT_EQ(aborted(),
            "startup timed out after 10 s:\n  sense has not found the reader of 'scan'\n"
            "  control has not reported");
}

TEST_F(SupervisedRun, EndsWhenTheOutcomeIsKnownAndEverybodyHasSteppedTheLastTick) {
  all_join();
  peer("drive").report(8, domain::Outcome::kReached);
  supervisor_->turn(now_);

  for (const std::string& stage : kStages) {
    const auto finish = peer(stage).take(FrameType::kFinish);
    ASSERT_EQ(finish.size(), 1u) << stage;
    EXPECT_EQ(finish[0].as<Tick>()->tick, 7u);
    EXPECT_FALSE(supervisor_->over());
    Finished finished;
    finished.chains[stage] = {};
    peer(stage).say(FrameType::kFinished, finished);
    supervisor_->turn(now_);
  }

  EXPECT_EQ(aborted(), "");
  EXPECT_TRUE(supervisor_->finish(now_).hash);
}

TEST_F(SupervisedRun, BringsBackAComponentThatWasKilled) {
  all_join();
  all_report(10);
  supervisor_->turn(now_);

  kill("sense");
  peers_.erase("sense");
  supervisor_->turn(now_);

  EXPECT_FALSE(supervisor_->over());
  EXPECT_TRUE(logged("was killed by signal 9 (Killed); restarting it"));
  EXPECT_TRUE(member("sense").child->running()) << "a new process";
  const auto assignment = join("sense").take(FrameType::kAssignment).at(0).as<Assignment>();
  EXPECT_TRUE(assignment->resumes);
  EXPECT_FALSE(assignment->checkpoint) << "none was reported: from tick 0";
}

TEST_F(SupervisedRun, GivesANewProcessTheCheckpointThatTheOthersHavePassed) {
  all_join();
  peer("sense").say(FrameType::kCheckpoint, Checkpoint{64, "old", "", {}});
  peer("sense").say(FrameType::kCheckpoint, Checkpoint{128, "new", "", {}});
  peer("sense").report(130);
  peer("drive").report(100);
  peer("control").report(100);
  supervisor_->turn(now_);

  kill("sense");
  peers_.erase("sense");
  supervisor_->turn(now_);

  const auto assignment = join("sense").take(FrameType::kAssignment).at(0).as<Assignment>();
  ASSERT_TRUE(assignment->checkpoint);
  EXPECT_EQ(assignment->checkpoint->node, "old");
}

TEST_F(SupervisedRun, WaitsAMomentForTheEndOfAProcessWhoseLineBroke) {
  all_join();

  peers_.erase("sense");
  supervisor_->turn(now_);
  EXPECT_TRUE(log_.empty()) << "its end says more";
  now_ += kEndGrace;
  supervisor_->turn(now_);

  EXPECT_TRUE(logged("sense has left the run; restarting it"));
}

/// The robot stood still when drive was last heard; a command may be on its way.
TEST_F(SupervisedRun, DoesNotRestartInRealTimeAndSaysSoToDriveFirst) {
  layout_.pace = Pace::kRealtime;
  TearDown();
  begin();
  all_join();

  kill("control");
  peers_.erase("control");
  supervisor_->turn(now_);

  EXPECT_EQ(peer("drive").take(FrameType::kRest).size(), 1u);
  EXPECT_FALSE(supervisor_->over());
  pass(milliseconds(300));
  EXPECT_NE(aborted().find("; in real time it is not restarted"), std::string::npos);
}

TEST_F(SupervisedRun, KillsAProcessThatDoesNotReport) {
  all_join();
  all_report(1);
  supervisor_->turn(now_);
  const int frozen = member("sense").child->process_id();

  pass(kFrozenAfter + milliseconds(200), {"sense"});

  EXPECT_TRUE(logged("sense (process " + std::to_string(frozen) + ") does not report; killing it"));
  EXPECT_FALSE(supervisor_->over());
}

TEST_F(SupervisedRun, IsNotHeldUpByAProcessThatNeverReadsItsAssignment) {
  plan_.bundle["maps/large.image"] = std::string(std::size_t{8} << 20, 'x');
  join("drive");
  join("control");
  join("sense");  // and reads nothing

  pass(kFrozenAfter + milliseconds(200), {"sense"});

  EXPECT_TRUE(logged("does not report; killing it"));
  supervisor_->interrupt(SIGINT, now_);
  EXPECT_EQ(aborted(), "interrupted by signal 2 (Interrupt)");
}

TEST_F(SupervisedRun, HasNoPlaceForAStranger) {
  all_join();

  Peer& stranger = join("plan");
  Peer& second = join("a second one", hello_of("sense"));

  EXPECT_EQ(stranger.take(FrameType::kNotice).at(0).as<Text>()->text,
            "this run has no place for a component plan");
  EXPECT_TRUE(second.closed());
  EXPECT_FALSE(supervisor_->over());
}

TEST_F(SupervisedRun, IsAbortedByAProgramOfOursThatIsOfAnotherBuild) {
  join("sense", Hello{"sense", 7, "00"});

  EXPECT_NE(aborted().find("sense (process 7) was built from other IDL files"), std::string::npos);
}

TEST_F(SupervisedRun, GoesOnWaitingWhenAPersonStartsAProgramOfAnotherBuild) {
  layout_.external = {"sense"};
  TearDown();
  begin();

  Peer& wrong = join("sense", Hello{"sense", 7, "00"});

  EXPECT_FALSE(supervisor_->over());
  EXPECT_EQ(wrong.take(FrameType::kNotice).size(), 1u);
  EXPECT_EQ(join("sense").take(FrameType::kAssignment).size(), 1u);
}

TEST_F(SupervisedRun, LetsDriveBeAQuarterOfAHistoryAhead) {
  all_join();
  const auto credit_of = [](const std::vector<Frame>& frames) {
    return frames.empty() ? 0 : frames.back().as<Tick>()->tick;
  };
  EXPECT_EQ(credit_of(peer("drive").take(FrameType::kCredit)), kLead);

  peer("drive").report(kLead);
  peer("sense").report(kLead);
  supervisor_->turn(now_);
  EXPECT_TRUE(peer("drive").take(FrameType::kCredit).empty()) << "control has done none";
  peer("control").report(kLead);
  supervisor_->turn(now_);

  EXPECT_EQ(credit_of(peer("drive").take(FrameType::kCredit)), 2 * kLead);
}

TEST_F(SupervisedRun, GoesOnWhenAComponentSendsNonsense) {
  all_join();

  peer("sense").say(FrameType::kProgress, Text{"no progress"});
  peer("sense").say(FrameType::kAssignment, Text{"not its to give"});
  supervisor_->turn(now_);

  EXPECT_FALSE(supervisor_->over());
}

TEST_F(SupervisedRun, IsAbortedByAComponentThatCannotGoOn) {
  all_join();

  peer("control").say(FrameType::kFatal, Text{"control lost 'scan' of tick 3"});
  supervisor_->turn(now_);

  EXPECT_EQ(aborted(), "control lost 'scan' of tick 3");
}

/// A page that somebody looks at.
class OpenPage : public RunPage {
 public:
  const std::string& address() const override { return address_; }
  std::optional<core::Result<std::string>> open(const std::string&) override { return address_; }
  void add(std::string_view) override {}
  void add_intervention(const domain::Intervention&) override {}

 private:
  std::string address_ = "here";
};

/// The same run with a page, and another goal from tick 1000 on.
class ShownRun : public SupervisedRun {
 protected:
  ShownRun() {
    run_control_.set_page(&page_);
    const auto planned = run_control_.plan({runtime::planned_at(1000, {"goal=1,1"})});
    EXPECT_TRUE(planned.ok()) << planned.error().text();
    control_ = &run_control_;
  }
  void TearDown() override {
    SupervisedRun::TearDown();
    supervisor_.reset();  // before its page
  }
  std::vector<std::size_t> told_to_show() {
    std::vector<std::size_t> told;
    for (const std::string& stage : kStages) {
      told.push_back(peer(stage).take(FrameType::kSpool).size());
    }
    return told;
  }
  void get_to(std::uint64_t tick) {
    all_report(tick);
    supervisor_->turn(now_);
  }

  OpenPage page_;
  runtime::BundleSource files_{plan_.bundle};
  RunControl run_control_{plan_, stages::all(), files_};
};

TEST_F(ShownRun, TellsEverybodyAtTheStartAndShortlyBeforeAPlannedChange) {
  using Told = std::vector<std::size_t>;
  all_join();
  EXPECT_EQ(told_to_show(), (Told{1, 1, 1}));

  get_to(1000 - kLead - 1);
  EXPECT_EQ(told_to_show(), (Told{0, 0, 0}));
  get_to(1000 - kLead);
  EXPECT_EQ(told_to_show(), (Told{1, 1, 1}));
  get_to(1000);
  EXPECT_EQ(told_to_show(), (Told{0, 0, 0}));
}

TEST_F(ShownRun, TellsAComponentThatComesBack) {
  all_join();
  get_to(100);
  told_to_show();

  kill("sense");
  peers_.erase("sense");
  supervisor_->turn(now_);

  EXPECT_EQ(join("sense").take(FrameType::kSpool).size(), 1U);
}

}  // namespace
}  // namespace clew::bridge
