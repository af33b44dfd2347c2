// SPDX-License-Identifier: Apache-2.0
#include "gateway/live_feed.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>

namespace clew::bridge {
namespace {

using Clock = std::chrono::steady_clock;

/// A feed to a program in the place of the gateway, which never says a word.
std::unique_ptr<LiveFeed> silent_feed() {
  auto feed = LiveFeed::start({"/bin/sh", "-c", "exec sleep 60"}, 0, RunDescription{}, "a", "a");
  if (!feed.ok()) ADD_FAILURE() << feed.error().text();
  return feed.ok() ? std::move(feed).value() : nullptr;
}

TEST(LiveFeed, ASignalThatAsksForAnEndIsNotKeptWaiting) {
  EndSignals signals;
  const auto feed = silent_feed();
  ASSERT_NE(feed, nullptr);
  ::raise(SIGINT);
  const auto begin = Clock::now();

  EXPECT_FALSE(feed->end("reached", signals));

  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(2));
}

TEST(LiveFeed, ASilentGatewayIsWaitedForInVain) {
  EndSignals signals;
  const auto feed = silent_feed();
  ASSERT_NE(feed, nullptr);
  const auto begin = Clock::now();

  EXPECT_TRUE(feed->end("reached", signals));

  EXPECT_GE(Clock::now() - begin, std::chrono::seconds(3));
}

}  // namespace
}  // namespace clew::bridge
