// SPDX-License-Identifier: Apache-2.0
#include "line/link.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <string>
#include <thread>

#include "socket_pair.hpp"

namespace clew::bridge {
namespace {

using Clock = std::chrono::steady_clock;

void send_raw(const Link& link, const std::string& bytes) {
  ASSERT_EQ(::send(link.socket(), bytes.data(), bytes.size(), MSG_NOSIGNAL),
            static_cast<ssize_t>(bytes.size()));
}

TEST(Link, BringsFramesInOrder) {
  const auto [here, there] = connected_links();
  there->post(FrameType::kNotice, Text{"first"});
  there->post(FrameType::kCredit, Tick{7});

  EXPECT_TRUE(here->receive());

  EXPECT_EQ(here->next()->as<Text>()->text, "first");
  EXPECT_EQ(here->next()->as<Tick>()->tick, 7u);
  EXPECT_FALSE(here->next());
}

TEST(Link, ClosesTheLineOverALengthThatNothingHas) {
  const auto [here, there] = connected_links();
  send_raw(*there, std::string("\0\xff\xff\xff\xff", 5));

  EXPECT_TRUE(here->receive());
  EXPECT_FALSE(here->next());
  EXPECT_FALSE(here->receive());
}

TEST(Link, AllowsOnlySoMuchBeforeTheOtherEndHasSaidWhoItIs) {
  const auto [here, there] = connected_links(16);
  there->post_bytes(FrameType::kNotice, std::string(17, 'x'));
  EXPECT_TRUE(here->receive());
  EXPECT_FALSE(here->next());
  EXPECT_FALSE(here->receive());

  const auto [known, peer] = connected_links(16);
  known->allow_payload(17);
  peer->post_bytes(FrameType::kNotice, std::string(17, 'x'));
  EXPECT_TRUE(known->receive());
  EXPECT_TRUE(known->next());
}

TEST(Link, TakesAPayloadThatIsNoMessageForNone) {
  const auto [here, there] = connected_links();
  there->post_bytes(FrameType::kProgress, "123");

  here->receive();

  EXPECT_FALSE(here->next()->as<Progress>());
}

TEST(Link, NeverWaitsForWhoDoesNotRead) {
  const auto [here, there] = connected_links();
  const std::string large(std::size_t{4} << 20, 'x');

  EXPECT_TRUE(here->post_bytes(FrameType::kAssignment, large));
  EXPECT_TRUE(here->post(FrameType::kGo, Tick{1}));

  EXPECT_TRUE(here->has_unsent());
  EXPECT_EQ(here->poll_events(), POLLIN | POLLOUT);
  EXPECT_FALSE(here->flush_until(Clock::now()));
  // Once it reads, all comes, in order.
  std::vector<Frame> frames;
  while (frames.size() < 2) {
    ASSERT_TRUE(there->receive());
    while (auto frame = there->next()) frames.push_back(*std::move(frame));
    ASSERT_TRUE(here->flush());
  }
  EXPECT_EQ(frames[0].payload, large);
  EXPECT_EQ(frames[1].type, FrameType::kGo);
  EXPECT_FALSE(here->has_unsent());
}

TEST(Link, KnowsThatTheOtherEndIsGone) {
  auto [here, there] = connected_links();
  there->post(FrameType::kNotice, Text{"last words"});
  there.reset();

  EXPECT_TRUE(here->receive());
  EXPECT_EQ(here->next()->as<Text>()->text, "last words");
  EXPECT_FALSE(here->receive());
  EXPECT_FALSE(here->post(FrameType::kGo, Tick{0}));
  EXPECT_EQ(here->wait_for_frame(Clock::now() + std::chrono::seconds(5)).error().message,
            "the supervisor has gone");
}

TEST(Link, SendsFromManyThreadsAtOnceWithoutMixingFrames) {
  const auto [here, there] = connected_links();
  constexpr std::size_t kFrames = 200;
  std::vector<std::thread> threads;
  for (char letter : {'a', 'b', 'c'}) {
    threads.emplace_back([letter, &link = *there] {
      for (std::size_t i = 0; i < kFrames; ++i) {
        link.post_bytes(FrameType::kSamples, std::string(1000, letter));
      }
    });
  }

  std::size_t received = 0;
  while (received < 3 * kFrames) {
    there->flush();
    ASSERT_TRUE(here->receive());
    while (const auto frame = here->next()) {
      EXPECT_EQ(frame->payload, std::string(1000, frame->payload.front()));
      ++received;
    }
  }
  for (std::thread& thread : threads) thread.join();
}

TEST(Peer, IsTrustedIfItIsOurselvesOrRoot) {
  EXPECT_TRUE(may_take_part(1000, 1000));
  EXPECT_TRUE(may_take_part(0, 1000));
  EXPECT_FALSE(may_take_part(1001, 1000));
  EXPECT_FALSE(may_take_part(1000, 0));
  const auto [here, there] = connected_links();
  EXPECT_TRUE(is_trusted_peer(here->socket()));
}

}  // namespace
}  // namespace clew::bridge
