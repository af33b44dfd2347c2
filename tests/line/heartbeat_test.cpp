// SPDX-License-Identifier: Apache-2.0
#include "line/heartbeat.hpp"

#include <gtest/gtest.h>

#include <future>

#include "run/limits.hpp"

namespace clew::bridge {
namespace {

TEST(Heartbeat, BeatsAtOnceAndAgain) {
  std::promise<void> first, second;
  int beats = 0;
  const Heartbeat heartbeat([&] {
    ++beats;
    if (beats == 1) first.set_value();
    if (beats == 2) second.set_value();
  });

  constexpr auto kPatience = std::chrono::seconds(20);
  EXPECT_EQ(first.get_future().wait_for(kPatience), std::future_status::ready);
  EXPECT_EQ(second.get_future().wait_for(kPatience), std::future_status::ready);
}

TEST(Heartbeat, EndsAtOnceAndBeatsNoMore) {
  int beats = 0;
  const auto started = std::chrono::steady_clock::now();
  for (int i = 0; i < 20; ++i) {
    const Heartbeat heartbeat([&] { ++beats; });
  }
  const int after = beats;

  EXPECT_LT(std::chrono::steady_clock::now() - started, 20 * kHeartbeatPeriod);
  EXPECT_EQ(beats, after);
}

TEST(Heartbeat, IsHeardBeforeAnybodyCallsTheProcessFrozen) {
  EXPECT_LE(5 * kHeartbeatPeriod, kFrozenAfter);
}

TEST(Watchdog, StrikesBeforeALeaseEnds) {
  // Participants announce themselves every 0.4 s at the least, and a supervisor looks every 20 ms.
  const std::chrono::duration<double> lease(kLease_s);

  EXPECT_LT(kFrozenAfter + kPollPeriod, lease - std::chrono::milliseconds(400));
}

}  // namespace
}  // namespace clew::bridge
