// SPDX-License-Identifier: Apache-2.0
#include "gateway/program_runs.hpp"

#include <gtest/gtest.h>
#include <poll.h>

#include <optional>

namespace clew::bridge {
namespace {

using Clock = std::chrono::steady_clock;

/// Polls until the program has ended.
ProgramEnd end_of(ProgramRuns& runs, const std::vector<std::string>& words) {
  std::optional<ProgramEnd> end;
  const auto started = runs.start(words, Clock::now(), [&](ProgramEnd told) { end = told; });
  EXPECT_TRUE(started.ok());
  while (!end && started.ok()) {
    runs.poll(Clock::now());
    ::poll(nullptr, 0, 1);
  }
  return end.value_or(ProgramEnd{});
}

TEST(ProgramRuns, TellsStatusAndOutputApart) {
  ProgramRuns runs(std::chrono::seconds(30));

  const ProgramEnd end = end_of(runs, {"/bin/sh", "-c", "echo out; echo err >&2; exit 3"});

  EXPECT_EQ(end.status, 3);
  EXPECT_EQ(end.out, "out\n");
  EXPECT_EQ(end.err, "err\n");
}

TEST(ProgramRuns, KillsWhatTakesTooLong) {
  ProgramRuns runs(std::chrono::milliseconds(20));

  EXPECT_EQ(end_of(runs, {"/bin/sleep", "60"}).status, 128 + 9);
}

TEST(ProgramRuns, RunsFourAtOnceAndNoMore) {
  ProgramRuns runs(std::chrono::seconds(30));
  const auto start = [&] {
    return runs.start({"/bin/sleep", "60"}, Clock::now(), [](const ProgramEnd&) {}).ok();
  };

  EXPECT_TRUE(start() && start() && start() && start());
  EXPECT_FALSE(start());
}

TEST(ProgramRuns, SaysWhatCannotBeStarted) {
  ProgramRuns runs(std::chrono::seconds(30));

  const auto started = runs.start({"/no/such/program"}, Clock::now(), [](const ProgramEnd&) {});

  ASSERT_FALSE(started.ok());
  EXPECT_EQ(started.error().text(),
            "/no/such/program: cannot be started: No such file or directory");
}

}  // namespace
}  // namespace clew::bridge
