// SPDX-License-Identifier: Apache-2.0
#include "supervisor/arrival_watch.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "run/limits.hpp"
#include "sleeping_process.hpp"

namespace clew::bridge {
namespace {

using std::chrono::milliseconds;
using Texts = std::vector<std::string>;

/// One process that was started; what the kernel says of it is the test's to say.
class ArrivalWatchTest : public testing::Test {
 protected:
  ArrivalWatchTest() {
    members_.emplace_back().stage = "sense";
    member().child.emplace(*start_sleeping({}));
  }
  ~ArrivalWatchTest() override { end_now(*member().child); }

  Member& member() { return members_.front(); }
  Texts look(milliseconds later) {
    now_ += later;
    return watch_.watch(members_, now_);
  }

  ProcessActivity activity_;
  std::vector<Member> members_;
  ArrivalWatch watch_{[this](auto) { return std::optional(activity_); }};
  ArrivalWatch::Time now_ = std::chrono::steady_clock::now();
};

TEST_F(ArrivalWatchTest, KillsWhoWasStoppedForSoLongBeforeItJoined) {
  activity_.stopped = true;
  EXPECT_EQ(look(milliseconds(0)), Texts{});
  EXPECT_EQ(look(kFrozenAfter - milliseconds(1)), Texts{});
  const std::string id = std::to_string(member().child->process_id());
  EXPECT_EQ(look(milliseconds(1)),
            Texts{"sense (process " + id + ") was stopped before it joined; killing it"});
  while (member().child->running()) member().child->reap();
  EXPECT_TRUE(member().child->was_killed());
}

TEST_F(ArrivalWatchTest, LeavesWhoGoesOnInTime) {
  activity_.stopped = true;
  look(milliseconds(0));
  activity_.stopped = false;
  look(kFrozenAfter / 2);
  activity_.stopped = true;
  look(kFrozenAfter / 2);
  EXPECT_EQ(look(kFrozenAfter / 2), Texts{});
  EXPECT_TRUE(member().child->running());
}

TEST_F(ArrivalWatchTest, WhoGetsProcessorTimeOrWouldTakeItGetsOn) {
  look(milliseconds(20));
  EXPECT_EQ(member().worked_at, ArrivalWatch::Time{}) << "it sleeps";
  activity_.processor_s = 0.01;
  look(milliseconds(20));
  EXPECT_EQ(member().worked_at, now_);
  const auto before = now_;
  look(milliseconds(20));
  EXPECT_EQ(member().worked_at, before) << "no more of it";
  activity_.runnable = true;
  look(milliseconds(20));
  EXPECT_EQ(member().worked_at, now_);
}

TEST_F(ArrivalWatchTest, LooksAtNobodyElse) {
  activity_.stopped = true;
  member().down = true;
  look(milliseconds(0));
  EXPECT_EQ(look(2 * kFrozenAfter), Texts{}) << "it is about to be started anew";
  member().down = false;
  member().host = "robot";
  look(milliseconds(0));
  EXPECT_EQ(look(2 * kFrozenAfter), Texts{}) << "it waits for its host";
}

}  // namespace
}  // namespace clew::bridge
