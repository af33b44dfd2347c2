// SPDX-License-Identifier: Apache-2.0
#include "gateway/live_feed.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <string>
#include <vector>

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

/// A page that somebody looks at or not, and the ticks of the states that it got.
class Looker : public RunPage {
 public:
  const std::string& address() const override { return address_; }
  std::optional<core::Result<std::string>> open(const std::string&) override { return address_; }
  void add(std::string_view spool) override {
    for_each_spooled(spool, {[](const SampleView&) {},
                             [this](const SpooledState& state) { ticks.push_back(state.tick); }});
  }
  void add_intervention(const domain::Intervention&) override {}

  std::vector<std::uint64_t> ticks;
  std::string address_ = "here";
};

/// What a composed run does with its sink at a tick.
void run_until(std::uint64_t end, FedSink& sink, std::uint64_t& tick) {
  const std::string state = "state";
  for (; tick < end; ++tick) {
    if (tick > 0 && tick % kTicksPerCheckpoint == 0 && sink.wants_states()) {
      sink.add_state({"drive", tick, state});
    }
    ASSERT_TRUE(sink.add({domain::Topic::kState, tick, tick, "sample"}).ok());
  }
}

std::vector<std::uint64_t> checkpoints_after(std::uint64_t tick, std::size_t count) {
  std::vector<std::uint64_t> ticks;
  for (std::uint64_t next = tick / kTicksPerCheckpoint + 1; ticks.size() < count; ++next) {
    ticks.push_back(next * kTicksPerCheckpoint);
  }
  return ticks;
}

TEST(FedSink, ShowsStatesAtTheStartAndAfterAPlannedChange) {
  Looker page;
  std::uint64_t tick = 0;
  {
    FedSink sink(nullptr, page);
    sink.add_intervention({5000, 4488, {"goal=1,2"}, {}, {}});
    run_until(8000, sink, tick);
  }

  auto expected = checkpoints_after(0, kFirstShownStates);
  expected.push_back(kTicksPerShownState);
  for (const std::uint64_t each : checkpoints_after(5000, kFirstShownStates)) {
    expected.push_back(each);
  }
  EXPECT_EQ(page.ticks, expected);
}

TEST(FedSink, ShowsStatesAfterAChangeThatWasPlannedBeforeSomebodyLookedOn) {
  Looker page;
  page.address_.clear();
  std::uint64_t tick = 0;
  {
    FedSink sink(nullptr, page);
    sink.add_intervention({2000, 1488, {"goal=1,2"}, {}, {}});
    sink.add_intervention({300, 0, {"goal=3,4"}, {}, {}});
    run_until(500, sink, tick);
    page.address_ = "here";
    run_until(4000, sink, tick);
  }

  auto expected = checkpoints_after(500, kFirstShownStates);
  for (const std::uint64_t each : checkpoints_after(2000, kFirstShownStates)) {
    expected.push_back(each);
  }
  EXPECT_EQ(page.ticks, expected);
}

}  // namespace
}  // namespace clew::bridge
