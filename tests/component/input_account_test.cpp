// SPDX-License-Identifier: Apache-2.0
#include "component/input_account.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fake_participant.hpp"
#include "line/user_data.hpp"

namespace clew::bridge {
namespace {

using domain::Topic;

std::string command_of(std::uint64_t tick, std::uint64_t miscounted = 0, double turn_rad = 0.0) {
  domain::Command command;
  command.stamp = {tick, 0.1 * static_cast<double>(tick), tick + miscounted};
  if (turn_rad != 0.0) command.motion.kind = domain::CommandKind::kTurnAndStep;
  command.motion.turn_rad = turn_rad;
  Codec<domain::Command> codec;
  return std::string(codec.encode(command));
}

class Account : public testing::Test {
 protected:
  explicit Account(Pace pace = Pace::kLockstep)
      : writer_(
            remote(true, "command", "", UserData{std::string(idl_fingerprint()), ""}.to_text())),
        barrier_("the run", {{"command", true, "control", true}},
                 {[] {}, [](auto) {}, [](auto) {}}) {
    Assignment assignment;
    assignment.pace = pace;
    assignment.spooling = Spooling::kSamples;
    account_ = std::make_unique<InputAccount>(
        "the run", runtime::TopicSet().set(domain::index_of(Topic::kCommand)), assignment,
        domain::ScanLayout{});
    EXPECT_TRUE(account_->open(participant_, barrier_).ok());
    barrier_.on_matched(writer_);
  }
  void deliver(std::uint64_t tick) { participant_.deliver("command", command_of(tick), &writer_); }

  FakeParticipant participant_;
  RemoteEndpoint writer_;
  StartBarrier barrier_;
  std::unique_ptr<InputAccount> account_;
};

class RealtimeAccount : public Account {
 protected:
  RealtimeAccount() : Account(Pace::kRealtime) {}
};

TEST_F(Account, HashesAndSpoolsWhatComesAsItsWriterWould) {
  SampleAccount writers(true, true);
  for (std::uint64_t tick = 0; tick < 3; ++tick) {
    deliver(tick);
    domain::Command command;
    Codec<domain::Command> codec;
    ASSERT_TRUE(codec.decode(command_of(tick), command).ok());
    writers.add(command, command_of(tick));
  }

  ASSERT_TRUE(account_->finished(2));
  EXPECT_EQ(account_->finished(2)->chains, writers.chains());
  EXPECT_EQ(account_->take_spooled(), writers.take_spooled());
  EXPECT_EQ(account_->progress().ticks, 3u);
}

TEST_F(Account, GoesOnFromACheckpointAsIfItHadSeenAllBefore) {
  SampleAccount before(true, false);
  for (std::uint64_t tick = 0; tick < 2; ++tick) {
    domain::Command command;
    Codec<domain::Command> codec;
    ASSERT_TRUE(codec.decode(command_of(tick), command).ok());
    before.add(command, command_of(tick));
  }
  core::StateWriter writer;
  writer(before);

  ASSERT_TRUE(account_->restore({2, {}, writer.take(), {}}).ok());
  deliver(1);  // of a writer that begins a tick earlier
  deliver(2);

  domain::Command command;
  Codec<domain::Command> codec;
  ASSERT_TRUE(codec.decode(command_of(2), command).ok());
  before.add(command, command_of(2));
  ASSERT_TRUE(account_->finished(2));
  EXPECT_EQ(account_->finished(2)->chains, before.chains());
}

TEST_F(Account, WaitsInLockstepForWhatIsMissing) {
  deliver(1);

  EXPECT_EQ(account_->progress().ticks, 0u);
  EXPECT_FALSE(account_->finished(0));
}

TEST_F(RealtimeAccount, PassesOverWhatCanNoLongerCome) {
  deliver(1);

  EXPECT_EQ(account_->progress().ticks, 2u);
}

TEST_F(Account, EndsTheRunInLockstepOverASampleThatIsNone) {
  participant_.deliver("command", "no CDR", &writer_);

  ASSERT_TRUE(account_->fatal());
  EXPECT_EQ(account_->fatal()->rfind("the run refuses a sample of 'command': ", 0), 0u);
  EXPECT_EQ(account_->progress().refused_samples, 1u);
}

TEST_F(RealtimeAccount, OnlyTellsOfItInRealTime) {
  participant_.deliver("command", "no CDR", &writer_);

  EXPECT_FALSE(account_->fatal());
  EXPECT_EQ(account_->take_notices().size(), 1u);
  EXPECT_TRUE(account_->take_notices().empty());
}

TEST_F(Account, TellsOnceOfAWriterThatCountsWrongly) {
  deliver(0);
  participant_.deliver("command", command_of(1, 1000), &writer_);
  participant_.deliver("command", command_of(2, 1000), &writer_);

  EXPECT_EQ(account_->take_notices(),
            std::vector<std::string>{"the run has a sample of 'command' of tick 1 that its writer "
                                     "counts as number 1001; expected: 1"});
  EXPECT_EQ(account_->progress().ticks, 3u);
}

TEST_F(Account, TellsOfASampleThatIsWrittenAgainAndOtherwiseAndKeepsTheFirst) {
  SampleAccount first(true, true);
  domain::Command command;
  Codec<domain::Command> codec;
  ASSERT_TRUE(codec.decode(command_of(0), command).ok());
  first.add(command, command_of(0));

  deliver(0);
  deliver(0);
  EXPECT_TRUE(account_->take_notices().empty()) << "the same again is what a new process writes";
  participant_.deliver("command", command_of(0, 0, 0.5), &writer_);

  EXPECT_EQ(account_->take_notices(),
            std::vector<std::string>{"the run has a sample of 'command' of tick 0 once more, and "
                                     "otherwise; the first one holds"});
  EXPECT_EQ(account_->finished(0)->chains, first.chains());
}

TEST_F(Account, TurnsAwaySamplesOfStrangers) {
  participant_.deliver("command", command_of(0), nullptr);

  EXPECT_EQ(account_->progress().ticks, 0u);
  EXPECT_EQ(account_->progress().refused_samples, 1u);
}

}  // namespace
}  // namespace clew::bridge
