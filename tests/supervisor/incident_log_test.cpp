// SPDX-License-Identifier: Apache-2.0
#include "supervisor/incident_log.hpp"

#include <gtest/gtest.h>

namespace clew::bridge {
namespace {

domain::Incident refused(const std::string& text) { return {7, domain::kRefused, "control", text}; }

TEST(IncidentLog, TellsTheSameOnceAndCountsTheRest) {
  IncidentLog log;

  EXPECT_TRUE(log.note(refused("a writer")));
  EXPECT_FALSE(log.note(refused("a writer")));
  EXPECT_FALSE(log.note(refused("a writer")));

  const auto left_out = log.take_left_out();
  ASSERT_EQ(left_out.size(), 1u);
  EXPECT_EQ(left_out[0].kind, "refused");
  EXPECT_EQ(left_out[0].text,
            "2 more of this kind, the same again or beyond the 100 that are told");
  EXPECT_TRUE(log.take_left_out().empty()) << "it is told once";
}

TEST(IncidentLog, IsNotFilledByAStrangerWhoDoesANewThingEachTime) {
  IncidentLog log;
  std::size_t told = 0;

  for (int i = 0; i < 1000; ++i) told += log.note(refused(std::to_string(i))) ? 1 : 0;

  EXPECT_EQ(told, IncidentLog::kMostTold);
  EXPECT_TRUE(log.note({7, domain::kForeignReader, "control", "of another kind"}));
  ASSERT_EQ(log.take_left_out().size(), 1u);
}

TEST(IncidentLog, SteersNoTerminalAndKeepsALineShort) {
  IncidentLog log;

  EXPECT_EQ(log.note(refused("a\n\x1b[2Jb"))->text, "a\\x0a\\x1b[2Jb");
  EXPECT_EQ(log.note(refused(std::string(100'000, 'x')))->text.size(),
            domain::kMostIncidentBytes + 3);
}

TEST(Incident, IsCutBetweenLettersNotWithinOne) {
  std::string text;
  while (text.size() < 1000) text += "\xc3\xa9";  // two bytes
  text.insert(0, "x");

  EXPECT_EQ(domain::as_one_line(text), text.substr(0, 399) + "...");
}

}  // namespace
}  // namespace clew::bridge
