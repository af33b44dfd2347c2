// SPDX-License-Identifier: Apache-2.0
#include "line/acceptor.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <memory>
#include <string>
#include <vector>

#include "dds/rtps_ports.hpp"
#include "socket_pair.hpp"

namespace clew::bridge {
namespace {

using Time = Acceptor::Time;

using Refusals = std::vector<std::string>;

const Time kNow = std::chrono::steady_clock::now();

class Door : public testing::Test {
 protected:
  Door() : lock_(DomainLock::take({})) { EXPECT_TRUE(lock_.ok()); }

  /// A process that has connected.
  std::unique_ptr<Link> connect() {
    const auto socket = Link::connect(lock_->domain(), std::chrono::steady_clock::now());
    EXPECT_TRUE(socket.ok());
    return std::make_unique<Link>(*socket);
  }

  core::Result<DomainLock> lock_;
  Acceptor acceptor_{*lock_};
};

TEST_F(Door, LetsInWhoSaysHello) {
  const auto sense = connect();
  sense->post(FrameType::kHello, Hello{"sense", 42, "fingerprint"});

  const auto arrivals = acceptor_.arrivals(kNow);

  ASSERT_EQ(arrivals.size(), 1u);
  EXPECT_EQ(arrivals[0].second.stage, "sense");
  EXPECT_EQ(acceptor_.sockets().size(), 1u) << "nobody waits any more";
}

TEST_F(Door, WaitsForWhoHasNotSpokenButNotForEver) {
  const auto silent = connect();

  EXPECT_TRUE(acceptor_.arrivals(kNow).empty());
  EXPECT_EQ(acceptor_.sockets().size(), 2u);
  acceptor_.arrivals(kNow + kHelloTimeout + std::chrono::milliseconds(1));

  EXPECT_EQ(acceptor_.sockets().size(), 1u);
  EXPECT_FALSE(silent->receive()) << "it is told by the end of its line";
  EXPECT_EQ(acceptor_.take_refusals(),
            Refusals{"a process has connected and said nothing; it is turned away"});
  EXPECT_TRUE(acceptor_.take_refusals().empty());
}

TEST_F(Door, TurnsAwayWhoSaysSomethingElse) {
  const auto other = connect();
  other->post(FrameType::kFatal, Text{"stop all"});

  EXPECT_TRUE(acceptor_.arrivals(kNow).empty());

  EXPECT_EQ(acceptor_.sockets().size(), 1u);
  EXPECT_EQ(acceptor_.take_refusals(),
            Refusals{"a process has connected and said no hello; it is turned away"});
}

TEST_F(Door, TurnsAwayAFrameLargerThanAnyHello) {
  const auto large = connect();
  large->post_bytes(FrameType::kHello, std::string(kMostHelloBytes + 1, 'x'));

  EXPECT_TRUE(acceptor_.arrivals(kNow).empty());
  EXPECT_TRUE(acceptor_.arrivals(kNow).empty());

  EXPECT_EQ(acceptor_.sockets().size(), 1u);
}

TEST_F(Door, SendsTheOldestAwayWhenTooManyStandBeforeIt) {
  std::vector<std::unique_ptr<Link>> crowd;
  for (std::size_t i = 0; i <= kMostNewcomers; ++i) {
    crowd.push_back(connect());
    acceptor_.arrivals(kNow);
  }

  EXPECT_EQ(acceptor_.sockets().size(), 1 + kMostNewcomers);
  EXPECT_FALSE(crowd[0]->receive());
  EXPECT_EQ(acceptor_.take_refusals(),
            Refusals{"a process has connected and said nothing, and too many have come after it; "
                     "it is turned away"});
  crowd.back()->post(FrameType::kHello, Hello{"sense", 42, "fingerprint"});
  EXPECT_EQ(acceptor_.arrivals(kNow).size(), 1u);
}

TEST_F(Door, HearsWhoSpokeBeforeACrowdCame) {
  const auto sense = connect();
  EXPECT_TRUE(acceptor_.arrivals(kNow).empty());
  sense->post(FrameType::kHello, Hello{"sense", 42, "fingerprint"});
  std::vector<std::unique_ptr<Link>> crowd;
  for (std::size_t i = 0; i < kMostNewcomers; ++i) crowd.push_back(connect());

  EXPECT_EQ(acceptor_.arrivals(kNow).size(), 1u);
}

TEST_F(Door, KeepsAProcessOfTheRunHoweverManyStrangersCome) {
  int speak[2];
  ASSERT_EQ(::pipe(speak), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const auto own = connect();
    char sign = 0;
    const bool told = ::read(speak[0], &sign, 1) == 1;
    _exit(told && own->post(FrameType::kHello, Hello{"sense", 42, "fingerprint"}) ? 0 : 1);
  }
  const Time deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (acceptor_.sockets().size() == 1) {
    ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "the child does not connect";
    acceptor_.arrivals(kNow);
  }
  std::vector<std::unique_ptr<Link>> crowd;
  for (std::size_t i = 0; i < 2 * kMostNewcomers; ++i) {
    crowd.push_back(connect());
    acceptor_.arrivals(kNow);
  }

  EXPECT_EQ(acceptor_.sockets().size(), 1 + 1 + kMostNewcomers);
  ASSERT_EQ(::write(speak[1], "!", 1), 1);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  const auto arrivals = acceptor_.arrivals(kNow);
  ASSERT_EQ(arrivals.size(), 1u);
  EXPECT_EQ(arrivals[0].second.stage, "sense");
  for (const int end : speak) ::close(end);
}

TEST(DomainLock, IsHeldByOneAtATime) {
  const auto first = DomainLock::take({});
  ASSERT_TRUE(first.ok());

  const auto second = DomainLock::take(first->domain());
  const auto third = DomainLock::take({});

  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.error().message,
            "domain " + std::to_string(first->domain()) + " is held by another run");
  ASSERT_TRUE(third.ok());
  EXPECT_NE(third->domain(), first->domain());
}

TEST(DomainLock, EndsWithItsObject) {
  int domain = 0;
  {
    const auto lock = DomainLock::take({});
    ASSERT_TRUE(lock.ok());
    domain = lock->domain();
  }

  EXPECT_TRUE(DomainLock::take(domain).ok());
}

TEST(DomainLock, RefusesADomainThatOverlapsThePortsOfTheKernel) {
  EXPECT_FALSE(DomainLock::take(kMaxDomain + 1).ok());
  EXPECT_FALSE(DomainLock::take(-1).ok());
}

}  // namespace
}  // namespace clew::bridge
