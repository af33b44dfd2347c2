// SPDX-License-Identifier: Apache-2.0
#include "run/sample_account.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/archive.hpp"

namespace clew::bridge {
namespace {

domain::Command command_at(std::uint64_t tick) {
  domain::Command command;
  command.stamp = {tick, 0.1 * static_cast<double>(tick), tick};
  return command;
}

TEST(SampleAccount, ChainsTheBytesOfEachTopicThatWasWritten) {
  SampleAccount one(true, false), same(true, false), other(true, false);
  one.add(command_at(0), "bytes");
  same.add(command_at(0), "bytes");
  other.add(command_at(0), "bytez");

  EXPECT_EQ(one.chains().size(), 1u);
  EXPECT_EQ(one.chains(), same.chains());
  EXPECT_NE(one.chains(), other.chains());
}

TEST(SampleAccount, HasNoChainsWithoutHash) {
  SampleAccount account(false, false);
  account.add(command_at(0), {});

  EXPECT_FALSE(account.wants_bytes());
  EXPECT_TRUE(account.chains().empty());
}

TEST(SampleAccount, HandsOverWhatWasSpooledOnceAndInOrder) {
  SampleAccount account(true, true);
  account.add(command_at(0), "first");
  account.spool_state({"control", 64, "state"});
  account.add(command_at(1), "second");
  const std::string spool = account.take_spooled();

  std::vector<std::string> seen;
  EXPECT_TRUE(for_each_spooled(
      spool, {[&](const auto& sample) {
                seen.push_back(std::to_string(sample.tick) + std::string(sample.cdr));
              },
              [&](const SpooledState& state) {
                seen.push_back(std::string(state.stage) + std::to_string(state.tick) +
                               std::string(state.state));
              }}));
  EXPECT_EQ(seen, (std::vector<std::string>{"0first", "control64state", "1second"}));
  EXPECT_TRUE(account.take_spooled().empty());
}

TEST(SampleAccount, SpoolsWhatBefellTheRunBesideItsSamples) {
  const std::string spool = spooled(domain::Incident{3, "refused", "control", "a writer"});
  std::vector<domain::Incident> seen;
  SpoolVisitor visitor{[](const auto&) {}, [](const auto&) {}, nullptr,
                       [&](const domain::Incident& one) { seen.push_back(one); }};

  EXPECT_TRUE(for_each_spooled(spool, visitor));
  EXPECT_FALSE(for_each_spooled(std::string_view(spool).substr(0, spool.size() - 1), visitor));

  ASSERT_EQ(seen.size(), 1u);
  EXPECT_EQ(seen[0].tick, 3u);
  EXPECT_EQ(seen[0].text, "a writer");
}

TEST(SampleAccount, SpoolsFromWhenSomebodyAsksForIt) {
  SampleAccount account(true, false);
  SampleAccount unwatched(true, false);
  account.add(command_at(0), "first");
  unwatched.add(command_at(0), "first");

  account.spool();
  account.add(command_at(1), "second");
  unwatched.add(command_at(1), "second");

  std::vector<std::uint64_t> ticks;
  EXPECT_TRUE(for_each_spooled(
      account.take_spooled(),
      {[&](const auto& sample) { ticks.push_back(sample.tick); }, [](const SpooledState&) {}}));
  EXPECT_EQ(ticks, std::vector<std::uint64_t>{1});
  EXPECT_EQ(account.chains(), unwatched.chains());
}

TEST(SampleAccount, SeesThatASpoolIsTorn) {
  SampleAccount account(false, true);
  account.add(command_at(0), "first");
  account.spool_state({"control", 64, "state"});
  const std::string spool = account.take_spooled();
  const SpoolVisitor nobody{[](const auto&) {}, [](const auto&) {}};

  int whole = 0;
  for (std::size_t size = 0; size <= spool.size(); ++size) {
    if (for_each_spooled(std::string_view(spool).substr(0, size), nobody)) ++whole;
  }
  // Nothing, the first entry, and both.
  EXPECT_EQ(whole, 3);
  EXPECT_FALSE(for_each_spooled(std::string(64, '\xff'), nobody));
}

TEST(SampleAccount, GoesOnFromWhereItWasSaved) {
  SampleAccount whole(true, false), first(true, false), second(true, false);
  whole.add(command_at(0), "a");
  whole.add(command_at(1), "b");
  first.add(command_at(0), "a");
  core::StateWriter writer;
  writer(first);
  const std::string saved = writer.take();
  core::StateReader reader(saved);
  reader(second);
  ASSERT_TRUE(reader.complete());
  second.add(command_at(1), "b");

  EXPECT_EQ(second.chains(), whole.chains());
}

domain::Event event_of(domain::EventKind kind, const std::string& rule, bool shadow) {
  domain::Event event;
  domain::EventEntry entry;
  entry.kind = kind;
  entry.rule = rule;
  entry.shadow = shadow;
  event.entries.push_back(entry);
  return event;
}

TEST(RunStatistics, CountTrapsOfTheDetectorInCommandAndAlarmsOfAll) {
  RunStatistics statistics;
  statistics.add(event_of(domain::EventKind::kTrap, "revisit", false));
  statistics.add(event_of(domain::EventKind::kTrap, "oscillation", true));
  statistics.add(event_of(domain::EventKind::kVirtualTarget, "", false));

  EXPECT_EQ(statistics.traps_detected, 1u);
  EXPECT_EQ(statistics.virtual_targets, 1u);
  EXPECT_EQ(statistics.alarms["revisit"].in_command, 1u);
  EXPECT_EQ(statistics.alarms["oscillation"].in_shadow, 1u);
}

TEST(RunStatistics, HoldNoMoreRulesThanAStrangerMayName) {
  RunStatistics statistics;
  for (std::size_t i = 0; i < 2 * RunStatistics::kMostRules; ++i) {
    statistics.add(event_of(domain::EventKind::kTrap, "rule" + std::to_string(i), false));
  }

  EXPECT_EQ(statistics.alarms.size(), RunStatistics::kMostRules);
  EXPECT_EQ(statistics.traps_detected, 2 * RunStatistics::kMostRules);
}

TEST(RunStatistics, OfSeveralProcessesAddUp) {
  RunStatistics drive, recover;
  domain::State state;
  state.stamp.tick = 7;
  state.path_length_m = 3.5;
  drive.add(state);
  recover.add(event_of(domain::EventKind::kTrap, "revisit", false));

  drive.merge(recover);

  EXPECT_EQ(drive.truth->tick, 7u);
  EXPECT_EQ(drive.truth->path_length_m, 3.5);
  EXPECT_EQ(drive.traps_detected, 1u);
  EXPECT_EQ(drive.alarms["revisit"].in_command, 1u);
}

}  // namespace
}  // namespace clew::bridge
