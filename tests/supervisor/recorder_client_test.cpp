// SPDX-License-Identifier: Apache-2.0
#include "supervisor/recorder_client.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include <memory>
#include <string>
#include <utility>

namespace clew::bridge {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

/// The recorder's end of a line, by hand.
class Recorder {
 public:
  explicit Recorder(RecorderClient& keeper) {
    int sockets[2] = {-1, -1};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets), 0);
    line_ = std::make_unique<Link>(sockets[0]);
    keeper.welcome(std::make_unique<Link>(sockets[1]), std::chrono::steady_clock::now());
  }

  void report(const Kept& kept) { line_->post(FrameType::kKept, kept); }
  void say_how_it_went(RecordingAccount account) {
    line_->post(FrameType::kRecorded, std::move(account));
  }
  /// The samples' bytes that come in all. A line takes less than a batch at a time, so a batch is
  /// here after a few turns at the latest.
  std::size_t take_samples(RecorderClient& keeper) {
    constexpr int kTurns = 64;
    std::size_t bytes = 0;
    for (int idle = 0; idle < kTurns; ++idle) {
      keeper.serve(std::chrono::steady_clock::now());
      line_->receive();
      while (const auto frame = line_->next()) {
        if (frame->type != FrameType::kSamples) continue;
        bytes += frame->payload.size();
        idle = 0;
      }
    }
    return bytes;
  }

 private:
  std::unique_ptr<Link> line_;
};

RecorderClient keeper_that(bool drops) { return {RecordingOrder{}, ChildCommand{}, drops}; }

/// 100 batches of a MiB, of a tick each, for a recorder that does not take them.
void add_100(RecorderClient& keeper) {
  for (std::uint64_t tick = 0; tick < 100; ++tick) keeper.add(std::string(kMiB, 's'), tick + 1);
}

TEST(RecorderClient, DropsInRealTimeWhatTheRecorderDoesNotTake) {
  RecorderClient keeper = keeper_that(true);
  Recorder recorder(keeper);
  recorder.report({});

  add_100(keeper);

  // 64 MiB are kept, and nothing waits for them.
  EXPECT_EQ(keeper.credit(), UINT64_MAX);
  EXPECT_EQ(recorder.take_samples(keeper), 64 * kMiB);
}

TEST(RecorderClient, KeepsAllInLockstepAndLetsTheRunWait) {
  RecorderClient keeper = keeper_that(false);
  Recorder recorder(keeper);
  recorder.report({});

  add_100(keeper);

  EXPECT_EQ(keeper.credit(), 256u);
  EXPECT_EQ(recorder.take_samples(keeper), 100 * kMiB);
}

TEST(RecorderClient, GivesASuccessorWhatIsNotDurable) {
  RecorderClient keeper = keeper_that(false);
  {
    Recorder recorder(keeper);
    recorder.report({});
    add_100(keeper);
    EXPECT_EQ(recorder.take_samples(keeper), 100 * kMiB);
    recorder.report({90, 60});
    keeper.serve(std::chrono::steady_clock::now());
  }
  keeper.serve(std::chrono::steady_clock::now());

  Recorder successor(keeper);
  successor.report({});

  // Ticks below 60 are durable; the run may go on from what the dead one had taken.
  EXPECT_EQ(keeper.credit(), 90u + 256u);
  EXPECT_EQ(successor.take_samples(keeper), 40 * kMiB);
}

TEST(RecorderClient, ReadsTheLastWordsOfAProcessThatHasEnded) {
  ChildCommand ends_at_once;
  ends_at_once.arguments = {"true"};
  RecorderClient keeper(RecordingOrder{}, ends_at_once, false);
  ASSERT_TRUE(keeper.start(std::chrono::steady_clock::now()).ok());
  Recorder recorder(keeper);
  siginfo_t ended;
  ASSERT_EQ(::waitid(P_ALL, 0, &ended, WEXITED | WNOWAIT), 0);

  keeper.serve(std::chrono::steady_clock::now());
  recorder.say_how_it_went({});
  keeper.serve(std::chrono::steady_clock::now());

  EXPECT_TRUE(keeper.account());
  EXPECT_EQ(keeper.restarts(), 0u);
}

}  // namespace
}  // namespace clew::bridge
