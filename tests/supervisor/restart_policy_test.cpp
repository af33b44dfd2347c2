// SPDX-License-Identifier: Apache-2.0
#include "supervisor/restart_policy.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <vector>

namespace clew::bridge {
namespace {

using std::chrono::seconds;
using Time = RestartPolicy::Time;

const Time kNow = std::chrono::steady_clock::now();

/// A member whose process only waits, and that is on the line since `age`.
Member waiting_member(const std::string& stage, seconds age) {
  Member member;
  member.stage = stage;
  member.stages = {stage};
  ChildCommand command;
  command.arguments = {"sleep", "60"};
  auto child = ChildProcess::start(command);
  EXPECT_TRUE(child.ok());
  member.child = std::move(child).value();
  int sockets[2] = {-1, -1};
  EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets), 0);
  member.link = std::make_unique<Link>(sockets[0]);
  ::close(sockets[1]);
  member.joined_at = kNow - age;
  member.heard_at = kNow;
  member.ready = true;
  return member;
}

class LonelyMember : public testing::Test {
 protected:
  void SetUp() override {
    members_.push_back(waiting_member("recover", seconds(9)));
    members_.push_back(waiting_member("classify", seconds(5)));
    members_[1].ready = false;
    members_[1].missing = {"classify has not found the reader of 'landmark' in recover"};
  }
  void TearDown() override {
    for (Member& member : members_) {
      if (!member.child) continue;
      member.child->signal(SIGKILL);
      while (!member.child->reap()) {
      }
    }
  }

  std::vector<Member> members_;
  runtime::Graph graph_;
};

TEST_F(LonelyMember, IsKilledOnceIfAllOthersAreThere) {
  RestartPolicy restarts(members_, graph_);

  const auto lines = restarts.kill_lonely(kNow, seconds(4));

  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0],
            "classify has not found the reader of 'landmark' in recover, which is there; "
            "killing process " +
                std::to_string(members_[1].child->process_id()));
  EXPECT_TRUE(restarts.kill_lonely(kNow + seconds(5), seconds(4)).empty());
}

TEST_F(LonelyMember, IsGivenTimeAfterTheLastOneHasCome) {
  members_[0].joined_at = kNow - seconds(1);
  RestartPolicy restarts(members_, graph_);

  EXPECT_TRUE(restarts.kill_lonely(kNow, seconds(4)).empty());
  EXPECT_EQ(restarts.kill_lonely(kNow + seconds(4), seconds(4)).size(), 1u);
}

TEST_F(LonelyMember, IsGivenTimeAfterTheLastOneHasMadeItsComponent) {
  core::StateWriter writer;
  Text doing{"recover still makes its component"};
  writer(doing);
  members_[0].note({FrameType::kPreparing, writer.take()}, kNow - seconds(1));
  RestartPolicy restarts(members_, graph_);

  EXPECT_EQ(members_[0].missing, std::vector<std::string>{doing.text});
  EXPECT_TRUE(restarts.kill_lonely(kNow, seconds(4)).empty());
}

TEST_F(LonelyMember, MayWaitForAComponentThatIsNotOurs) {
  members_.emplace_back();
  members_.back().stage = "control";
  members_.back().stages = {"control"};
  members_.back().third_party = true;
  RestartPolicy restarts(members_, graph_);

  EXPECT_TRUE(restarts.kill_lonely(kNow, seconds(4)).empty());
}

TEST_F(LonelyMember, IsNotOneThatHasNotSaidWhatItMisses) {
  members_[1].missing.clear();
  RestartPolicy restarts(members_, graph_);

  EXPECT_TRUE(restarts.kill_lonely(kNow, seconds(4)).empty());
}

TEST_F(LonelyMember, IsGivenAsLongAsTheRunSays) {
  RestartPolicy restarts(members_, graph_);

  EXPECT_TRUE(restarts.kill_lonely(kNow, seconds(6)).empty());
}

// A report of a process on another host may be lost on its way.
TEST(FrozenMember, IsGivenLongerOnAnotherHost) {
  std::vector<Member> members;
  members.push_back(waiting_member("sense", seconds(0)));
  runtime::Graph graph;
  RestartPolicy policy(members, graph);
  members[0].host = "far";
  members[0].heard_at = kNow;

  EXPECT_TRUE(policy.kill_frozen(kNow + seconds(3), seconds(1)).empty());
  EXPECT_EQ(policy.kill_frozen(kNow + seconds(4), seconds(1)).size(), 1u);
}

TEST(FrozenMember, IsGivenTwiceAsLongEachTimeUntilItGetsFurther) {
  std::vector<Member> members;
  members.push_back(waiting_member("sense", seconds(0)));
  runtime::Graph graph;
  RestartPolicy policy(members, graph);
  // Restarted again and again, it is heard once each time.
  std::vector<seconds> silences;
  for (const std::uint64_t ticks : {9U, 9U, 9U, 9U, 9U, 9U, 9U, 9U, 10U}) {
    members[0].progress.ticks = ticks;
    members[0].heard_at = kNow;
    seconds silence(0);
    while (policy.kill_frozen(kNow + silence, seconds(1)).empty()) ++silence;
    silences.push_back(silence);
  }

  const std::vector<seconds> doubled = {seconds(1),  seconds(2),  seconds(4),
                                        seconds(8),  seconds(16), seconds(32),
                                        seconds(32), seconds(32), seconds(1)};
  EXPECT_EQ(silences, doubled);
  while (!members[0].child->reap()) {
  }
}

}  // namespace
}  // namespace clew::bridge
