// SPDX-License-Identifier: Apache-2.0
/// What becomes of a run, decided by a supervisor whose clock is a number and whose components are
/// this test at the other ends of their lines.
#include "supervisor/supervisor.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <csignal>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "run/limits.hpp"
#include "sleeping_process.hpp"
#include "small_plan.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Texts = std::vector<std::string>;

const Texts kStages = {"drive", "sense", "control"};

Hello hello_of(const std::string& stage) { return {stage, 1, std::string(idl_fingerprint())}; }

/// The component's end of a line.
class Peer {
 public:
  explicit Peer(int socket) : link_(socket) {}

  template <typename Message>
  void say(FrameType type, Message message) {
    link_.post(type, std::move(message));
  }
  void report(std::uint64_t ticks, domain::Outcome outcome = domain::Outcome::kRunning) {
    Progress progress;
    progress.ticks = ticks;
    if (outcome != domain::Outcome::kRunning) {
      progress.statistics.truth.emplace();
      progress.statistics.truth->tick = ticks - 1;
      progress.statistics.truth->outcome = outcome;
    }
    say(FrameType::kProgress, progress);
  }
  /// The frames of a type that have come since the last call.
  std::vector<Frame> take(FrameType type) {
    while (link_.receive() && collect()) {
    }
    std::vector<Frame> taken = std::move(frames_[type]);
    frames_[type].clear();
    return taken;
  }
  bool closed() {
    while (link_.receive()) {
      if (!collect()) return false;
    }
    return true;
  }

 private:
  bool collect() {
    bool any = false;
    while (auto frame = link_.next()) {
      const FrameType type = frame->type;
      frames_[type].push_back(*std::move(frame));
      any = true;
    }
    return any;
  }

  Link link_;
  std::map<FrameType, std::vector<Frame>> frames_;
};

class Run : public testing::Test {
 protected:
  void SetUp() override { begin(); }
  void TearDown() override {
    for (Member& member : const_cast<std::vector<Member>&>(supervisor_->members())) {
      if (member.child) end_now(*member.child);
    }
  }

  void begin() {
    peers_.clear();
    supervisor_ = std::make_unique<Supervisor>(
        plan_, layout_, 1, std::nullopt, ProcessStart{},
        Supervisor::Outside{[this](const std::string& line) { log_.push_back(line); }, nullptr,
                            start_sleeping, [](auto) { return std::nullopt; }},
        now_);
    supervisor_->start();
  }
  const Member& member(const std::string& stage) const {
    return *find_member(const_cast<std::vector<Member>&>(supervisor_->members()), stage);
  }
  void kill(const std::string& stage, int number = SIGKILL) {
    end_now(const_cast<ChildProcess&>(*member(stage).child), number);
  }
  Peer& join(const std::string& stage, const Hello& hello) {
    int sockets[2] = {-1, -1};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets), 0);
    supervisor_->welcome(std::make_unique<Link>(sockets[0]), hello, now_);
    return *(peers_[stage] = std::make_unique<Peer>(sockets[1]));
  }
  Peer& join(const std::string& stage) { return join(stage, hello_of(stage)); }
  Peer& peer(const std::string& stage) { return *peers_.at(stage); }
  /// Everybody is there and has found the others.
  void all_join() {
    for (const std::string& stage : kStages) {
      join(stage).say(FrameType::kWaiting, Waiting{});
    }
    supervisor_->turn(now_);
  }
  void all_report(std::uint64_t ticks) {
    for (const std::string& stage : kStages) peer(stage).report(ticks);
  }
  /// Lets time pass while everybody reports that it lives.
  void pass(std::chrono::steady_clock::duration time, const Texts& silent = {}) {
    const auto end = now_ + time;
    while (now_ < end && !supervisor_->over()) {
      now_ += milliseconds(100);
      for (const std::string& stage : kStages) {
        const bool speaks = std::find(silent.begin(), silent.end(), stage) == silent.end();
        if (speaks && peers_.count(stage) != 0) peer(stage).say(FrameType::kAlive, Alive{busy_});
      }
      supervisor_->turn(now_);
    }
  }
  std::string aborted() {
    EXPECT_TRUE(supervisor_->over());
    return supervisor_->finish(now_).aborted;
  }
  bool logged(const std::string& text) const {
    return std::any_of(log_.begin(), log_.end(), [&](const std::string& line) {
      return line.find(text) != std::string::npos;
    });
  }

  runtime::RunPlan plan_ = small_plan();
  ProcessLayout layout_;
  Supervisor::Time now_ = std::chrono::steady_clock::now();
  Texts log_;
  std::map<std::string, std::unique_ptr<Peer>> peers_;
  std::unique_ptr<Supervisor> supervisor_;
  bool busy_ = false;
};

TEST_F(Run, BeginsWhenEverybodyHasFoundTheOthers) {
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

TEST_F(Run, TellsTheWorldOnlyToWhoMayKnowIt) {
  all_join();

  const auto drive = peer("drive").take(FrameType::kAssignment);
  const auto control = peer("control").take(FrameType::kAssignment);

  EXPECT_EQ(drive.at(0).as<Assignment>()->bundle.count("world.yaml"), 1u);
  EXPECT_EQ(control.at(0).as<Assignment>()->bundle.count("world.yaml"), 0u);
  EXPECT_EQ(control.at(0).as<Assignment>()->bundle.count("graph.yaml"), 1u);
}

TEST_F(Run, IsAbortedWhenTheStartTakesTooLongAndNamesWhoIsMissing) {
  join("drive");
  join("sense").say(FrameType::kWaiting, Waiting{{"sense has not found the reader of 'scan'"}});

  pass(seconds(11));

  EXPECT_EQ(aborted(),
            "startup timed out after 10 s:\n  sense has not found the reader of 'scan'\n"
            "  control has not reported");
}

TEST_F(Run, EndsWhenTheOutcomeIsKnownAndEverybodyHasSteppedTheLastTick) {
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

TEST_F(Run, BringsBackAComponentThatWasKilled) {
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

TEST_F(Run, GivesANewProcessTheCheckpointThatTheOthersHavePassed) {
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

TEST_F(Run, WaitsAMomentForTheEndOfAProcessWhoseLineBroke) {
  all_join();

  peers_.erase("sense");
  supervisor_->turn(now_);
  EXPECT_TRUE(log_.empty()) << "its end says more";
  now_ += kEndGrace;
  supervisor_->turn(now_);

  EXPECT_TRUE(logged("sense has left the run; restarting it"));
}

TEST_F(Run, DoesNotRestartInRealTime) {
  layout_.pace = Pace::kRealtime;
  TearDown();
  begin();
  all_join();

  kill("control");
  peers_.erase("control");
  supervisor_->turn(now_);

  EXPECT_NE(aborted().find("; in real time it is not restarted"), std::string::npos);
}

TEST_F(Run, KillsAProcessThatDoesNotReport) {
  all_join();
  all_report(1);
  supervisor_->turn(now_);
  const int frozen = member("sense").child->process_id();

  pass(kFrozenAfter + milliseconds(200), {"sense"});

  EXPECT_TRUE(logged("sense (process " + std::to_string(frozen) + ") does not report; killing it"));
  EXPECT_FALSE(supervisor_->over());
}

TEST_F(Run, IsNotHeldUpByAProcessThatNeverReadsItsAssignment) {
  plan_.bundle["maps/large.image"] = std::string(std::size_t{8} << 20, 'x');
  join("drive");
  join("control");
  join("sense");  // and reads nothing

  pass(kFrozenAfter + milliseconds(200), {"sense"});

  EXPECT_TRUE(logged("does not report; killing it"));
  supervisor_->interrupt(SIGINT, now_);
  EXPECT_EQ(aborted(), "interrupted by signal 2 (Interrupt)");
}

TEST_F(Run, AnswersAStallByStartingAllAnewAndThenByTheEnd) {
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

TEST_F(Run, WaitsForAStepThatTakesLong) {
  all_join();
  all_report(5);
  supervisor_->turn(now_);
  busy_ = true;

  pass(kStallTimeout + seconds(5));
  EXPECT_FALSE(supervisor_->over());
  EXPECT_TRUE(log_.empty());
  pass(kLongestStep);

  EXPECT_EQ(aborted(), "no tick was completed for 60 s; ticks done: drive 5 sense 5 control 5");
}

TEST_F(Run, HasNoPlaceForAStranger) {
  all_join();

  Peer& stranger = join("plan");
  Peer& second = join("a second one", hello_of("sense"));

  EXPECT_EQ(stranger.take(FrameType::kNotice).at(0).as<Text>()->text,
            "this run has no place for a component plan");
  EXPECT_TRUE(second.closed());
  EXPECT_FALSE(supervisor_->over());
}

TEST_F(Run, IsAbortedByAProgramOfOursThatIsOfAnotherBuild) {
  join("sense", Hello{"sense", 7, "00"});

  EXPECT_NE(aborted().find("sense (process 7) was built from other IDL files"), std::string::npos);
}

TEST_F(Run, GoesOnWaitingWhenAPersonStartsAProgramOfAnotherBuild) {
  layout_.external = {"sense"};
  TearDown();
  begin();

  Peer& wrong = join("sense", Hello{"sense", 7, "00"});

  EXPECT_FALSE(supervisor_->over());
  EXPECT_EQ(wrong.take(FrameType::kNotice).size(), 1u);
  EXPECT_EQ(join("sense").take(FrameType::kAssignment).size(), 1u);
}

TEST_F(Run, LetsDriveBeAQuarterOfAHistoryAhead) {
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

TEST_F(Run, GoesOnWhenAComponentSendsNonsense) {
  all_join();

  peer("sense").say(FrameType::kProgress, Text{"no progress"});
  peer("sense").say(FrameType::kAssignment, Text{"not its to give"});
  supervisor_->turn(now_);

  EXPECT_FALSE(supervisor_->over());
}

TEST_F(Run, IsAbortedByAComponentThatCannotGoOn) {
  all_join();

  peer("control").say(FrameType::kFatal, Text{"control lost 'scan' of tick 3"});
  supervisor_->turn(now_);

  EXPECT_EQ(aborted(), "control lost 'scan' of tick 3");
}

}  // namespace
}  // namespace clew::bridge
