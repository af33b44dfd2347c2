// SPDX-License-Identifier: Apache-2.0
#include "gateway/run_orders.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <optional>
#include <string>

#include "line/acceptor.hpp"
#include "line/command_desk.hpp"
#include "line/domain_lock.hpp"

namespace clew::bridge {
namespace {

using Clock = std::chrono::steady_clock;

/// A run's end of the line: what it takes commands with.
class CommandedRun {
 public:
  CommandedRun() : name_("orders-test-" + std::to_string(::getpid())) {
    auto taken = RunName::take(name_);
    EXPECT_TRUE(taken.ok());
    socket_.emplace(std::move(taken).value());
    acceptor_.emplace(std::vector<int>{socket_->socket()});
  }

  const std::string& name() const { return name_; }
  /// Answers what has arrived.
  void serve(const std::function<std::optional<CommandAnswer>(RunCommand&)>& decide) {
    const auto now = Clock::now();
    for (auto& [link, hello] : acceptor_->arrivals(now)) {
      EXPECT_EQ(hello.stage, kCommander);
      desk_.welcome(std::move(link), now);
    }
    desk_.serve(decide, now);
  }
  void end() {
    acceptor_.reset();
    desk_ = CommandDesk();
    socket_.reset();
  }

 private:
  std::string name_;
  std::optional<RunName> socket_;
  std::optional<Acceptor> acceptor_;
  CommandDesk desk_;
};

/// Polls until nothing is left; a line between two ends of one process needs a few turns.
void finish(RunOrders& orders, CommandedRun& run,
            const std::function<std::optional<CommandAnswer>(RunCommand&)>& decide) {
  for (const auto until = Clock::now() + std::chrono::seconds(20); Clock::now() < until;) {
    run.serve(decide);
    if (!orders.poll(Clock::now())) return;
  }
  FAIL() << "no answer";
}

TEST(RunOrders, BringACommandToTheRunAndItsAnswerBack) {
  CommandedRun run;
  RunOrders orders;
  std::optional<CommandAnswer> answered;
  RunCommand command{RunCommand::Kind::kPace};
  command.pace_factor = 2.5;

  const auto sent = orders.send(run.name(), command, Clock::now(), [&](const auto& answer) {
    ASSERT_TRUE(answer.ok());
    answered = *answer;
  });
  ASSERT_TRUE(sent.ok());
  double factor = 0.0;
  finish(orders, run, [&](RunCommand& taken) {
    factor = taken.pace_factor;
    return CommandAnswer::from(57);
  });

  EXPECT_EQ(factor, 2.5);
  ASSERT_TRUE(answered.has_value());
  EXPECT_EQ(answered->tick, 57U);
}

TEST(RunOrders, TellWhyARunRefuses) {
  CommandedRun run;
  RunOrders orders;
  std::string why;
  ASSERT_TRUE(orders
                  .send(run.name(), {RunCommand::Kind::kResume}, Clock::now(),
                        [&](const auto& answer) { why = answer.error().message; })
                  .ok());

  finish(orders, run, [](RunCommand&) { return CommandAnswer::refused("the run is not paused"); });

  EXPECT_EQ(why, "the run is not paused");
}

TEST(RunOrders, SayThatTheRunIsOverWhenItEndsWithoutAnAnswer) {
  CommandedRun run;
  RunOrders orders;
  std::string why;
  ASSERT_TRUE(orders
                  .send(run.name(), {RunCommand::Kind::kPause}, Clock::now(),
                        [&](const auto& answer) { why = answer.error().message; })
                  .ok());
  run.serve([](RunCommand&) { return std::nullopt; });
  run.end();

  while (orders.poll(Clock::now())) {
  }

  EXPECT_EQ(why, "the run is over");
}

TEST(RunOrders, GiveUpARunThatDoesNotAnswer) {
  CommandedRun run;
  RunOrders orders;
  std::string why;
  const auto now = Clock::now();
  ASSERT_TRUE(orders
                  .send(run.name(), {RunCommand::Kind::kPause}, now,
                        [&](const auto& answer) { why = answer.error().message; })
                  .ok());

  EXPECT_TRUE(orders.poll(now + std::chrono::seconds(29)));
  EXPECT_FALSE(orders.poll(now + std::chrono::seconds(31)));

  EXPECT_EQ(why, "the run does not answer");
}

TEST(RunOrders, AreAFewAtOnce) {
  CommandedRun run;
  RunOrders orders;
  const auto ignore = [](const auto&) {};
  for (int i = 0; i < 8; ++i) {
    ASSERT_TRUE(orders.send(run.name(), {RunCommand::Kind::kPause}, Clock::now(), ignore).ok());
  }

  EXPECT_FALSE(orders.send(run.name(), {RunCommand::Kind::kPause}, Clock::now(), ignore).ok());
}

}  // namespace
}  // namespace clew::bridge
