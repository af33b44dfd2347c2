// SPDX-License-Identifier: Apache-2.0
#include "supervisor/late_watch.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include "sleeping_process.hpp"
#include "small_plan.hpp"

namespace clew::bridge {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Time = LateWatch::Time;

/// Three members that have done ten ticks of 0.1 s, and what the kernel says of their processes.
class Late : public testing::Test {
 protected:
  explicit Late(const std::string& exec = {}) : plan_(small_plan(exec)) {
    plan_.graph.tick_s = 0.1;
    for (const runtime::GraphStage& stage : plan_.graph.stages) {
      Member& member = members_.emplace_back();
      member.stage = stage.info->name;
      member.stages = {member.stage};
      member.third_party = is_third_party(stage);
      member.starts_ticks = stage.ports.delayed_inputs.any();
      member.process_id = static_cast<std::int64_t>(members_.size());
      int sockets[2];
      EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, sockets), 0);
      member.link = std::make_unique<Link>(sockets[0]);
      ::close(sockets[1]);
      member.heard_at = now_;
      member.progress.ticks = 10;
    }
  }

  Member& member(const std::string& stage) { return *find_member(members_, stage); }
  LateWatch make(bool realtime) {
    return {plan_, realtime, [this](std::int64_t process_id) {
              return process_id == member(kernel_of_).process_id ? kernel_ : ProcessActivity{};
            }};
  }

  /// Time passes in looks of 20 ms, of which the process uses a share, and everybody reports.
  std::vector<std::string> pass(LateWatch& watch, Time::duration how_long,
                                double used_share = 0.0) {
    std::vector<std::string> told;
    for (const Time end = now_ + how_long; now_ < end;) {
      now_ += milliseconds(20);
      kernel_.processor_s += 0.02 * used_share;
      for (Member& one : members_) {
        if (!kernel_.stopped || one.stage != kernel_of_) one.heard_at = now_;
      }
      for (const auto& late : watch.watch(
               members_, [this](const auto&) { return written_; }, now_)) {
        EXPECT_EQ(late.kind, LateWatch::kIncident);
        told.push_back(late.text);
      }
    }
    return told;
  }

  runtime::RunPlan plan_;
  Time now_ = Time() + seconds(100);
  std::vector<Member> members_;
  std::string kernel_of_ = "control";
  ProcessActivity kernel_;
  std::uint64_t written_ = 10;
};

TEST_F(Late, NamesABusyLoopInRealTimeWithinASecondAndOnce) {
  LateWatch watch = make(true);
  member("control").busy = true;
  kernel_.runnable = true;

  EXPECT_EQ(pass(watch, seconds(5), 1.0),
            std::vector<std::string>{"control is late: 0.4 s ago it had done 10 ticks, and no more "
                                     "since; its process uses the processor, as a busy loop does"});
}

TEST_F(Late, NamesAStepThatSleepsOrIsLocked) {
  LateWatch watch = make(true);
  member("control").busy = true;

  const auto told = pass(watch, seconds(1));

  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("waits, as in a sleep or a dead-lock"), std::string::npos) << told[0];
}

TEST_F(Late, NamesAProcessThatIsStoppedThoughItDoesNotReport) {
  LateWatch watch = make(true);
  kernel_.stopped = true;

  const auto told = pass(watch, seconds(1));

  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("its process is stopped"), std::string::npos) << told[0];
}

TEST_F(Late, AccusesNobodyWhoWantsAProcessorAndIsGivenNone) {
  for (const bool realtime : {true, false}) {
    LateWatch watch = make(realtime);
    member("control").busy = true;
    kernel_.runnable = true;

    EXPECT_EQ(pass(watch, seconds(20), 0.0), std::vector<std::string>{});
  }
}

TEST_F(Late, CountsTheProcessorThatALoadedMachineGivesIt) {
  LateWatch watch = make(true);
  member("control").busy = true;
  kernel_.runnable = true;

  // A tenth of a processor: 0.3 s of it are there after three seconds.
  EXPECT_TRUE(pass(watch, milliseconds(2500), 0.1).empty());
  EXPECT_EQ(pass(watch, seconds(1), 0.1).size(), 1u);
}

TEST_F(Late, SaysNothingOfStepsThatEnd) {
  LateWatch watch = make(true);
  member("control").busy = true;
  kernel_.runnable = true;

  for (int i = 0; i < 50; ++i) {
    ++member("control").progress.ticks;
    EXPECT_TRUE(pass(watch, milliseconds(200), 1.0).empty());
  }
}

TEST_F(Late, LetsALargeSearchTakeItsTimeInLockstep) {
  LateWatch watch = make(false);
  member("control").busy = true;
  kernel_.runnable = true;

  EXPECT_TRUE(pass(watch, seconds(10), 1.0).empty());
  EXPECT_EQ(pass(watch, seconds(2), 1.0).size(), 1u);
}

TEST_F(Late, ForgetsWhatWasBeforeAPause) {
  LateWatch watch = make(true);
  member("control").busy = true;

  EXPECT_TRUE(pass(watch, milliseconds(300)).empty());
  watch.forget();
  EXPECT_TRUE(pass(watch, milliseconds(300)).empty());
}

TEST_F(Late, WhoIsOnAnotherHostIsNotNamed) {
  LateWatch watch = make(true);
  member("control").busy = true;
  member("control").host = "robot";
  EXPECT_TRUE(pass(watch, seconds(2)).empty()) << "its process here is a relay, which waits";

  member("control").host.clear();
  EXPECT_EQ(pass(watch, seconds(2)).size(), 1u);
}

/// The same with a control of somebody else's, of which only the wire tells.
class LateProgram : public Late {
 protected:
  LateProgram() : Late("sleepy") {}
};

TEST_F(LateProgram, IsNamedWhenItWritesNothingThoughItsInputsAreThere) {
  LateWatch watch = make(true);
  member("drive").progress.ticks = 11;
  member("sense").progress.ticks = 11;

  EXPECT_EQ(pass(watch, seconds(2)),
            std::vector<std::string>{
                "control is late: 0.4 s after its inputs of tick 10 it has written nothing; its "
                "process waits, as in a sleep or a dead-lock"});
}

TEST_F(LateProgram, IsNotNamedWhileItWaitsForAnother) {
  LateWatch watch = make(true);
  member("drive").progress.ticks = 11;

  EXPECT_TRUE(pass(watch, seconds(2)).empty()) << "sense has not stepped";
}

TEST(ProcessActivity, SeesWhetherAProcessIsStopped) {
  auto process = start_sleeping({});
  ASSERT_TRUE(process.ok());
  process->signal(SIGSTOP);

  bool stopped = false;
  const Time until = std::chrono::steady_clock::now() + seconds(10);
  while (!stopped && std::chrono::steady_clock::now() < until) {
    const auto activity = activity_of(process->process_id());
    ASSERT_TRUE(activity);
    stopped = activity->stopped;
  }

  EXPECT_TRUE(stopped);
  end_now(*process);
}

TEST(ProcessActivity, CountsProcessorTimeAndKnowsNothingOfNobody) {
  const auto before = activity_of(::getpid());
  ASSERT_TRUE(before);

  auto after = before;
  const Time until = std::chrono::steady_clock::now() + seconds(10);
  while (after->processor_s <= before->processor_s && std::chrono::steady_clock::now() < until) {
    after = activity_of(::getpid());
  }

  EXPECT_GT(after->processor_s, before->processor_s);
  EXPECT_TRUE(after->runnable) << "it is running just now";
  EXPECT_FALSE(activity_of(-1));
}

}  // namespace
}  // namespace clew::bridge
