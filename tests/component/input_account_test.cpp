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

std::string command_of(std::uint64_t tick) {
  domain::Command command;
  command.stamp = {tick, 0.1 * static_cast<double>(tick), tick};
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

TEST_F(Account, TurnsAwaySamplesOfStrangers) {
  participant_.deliver("command", command_of(0), nullptr);

  EXPECT_EQ(account_->progress().ticks, 0u);
  EXPECT_EQ(account_->progress().refused_samples, 1u);
}

}  // namespace
}  // namespace clew::bridge
