// SPDX-License-Identifier: Apache-2.0
#include "gateway/live_stream.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "gateway/page_client.hpp"
#include "run/sample_account.hpp"
#include "run/spool.hpp"

namespace clew::bridge {
namespace {

using domain::Topic;

/// A client's end that takes everything at once, or nothing.
class Taker : public SocketSender {
 public:
  void send_text(std::string text) override { texts.push_back(nlohmann::json::parse(text)); }
  void send_binary(std::shared_ptr<const std::string> bytes) override { sent.push_back(*bytes); }
  std::size_t queued_bytes() const override { return queued; }

  std::vector<nlohmann::json> texts;
  std::vector<std::string> sent;
  std::size_t queued = 0;
};

std::string record(Topic topic, std::uint64_t tick) {
  std::string spool;
  append_to_spool({topic, tick, tick, "bytes"}, spool);
  return spool;
}

/// Both topics of a tick.
std::string whole_tick(std::uint64_t tick) {
  return record(Topic::kState, tick) + record(Topic::kScan, tick);
}

class ALiveStream : public ::testing::Test {
 protected:
  ALiveStream() {
    RunDescription description;
    description.tick_s = 0.1;
    description.schemas = {{Topic::kState, "idl"}, {Topic::kScan, "idl"}};
    stream_.describe(description, "run");
  }

  LiveStream stream_{10000};
  Taker taker_;
};

TEST_F(ALiveStream, TellsAPageWhatWasChangedAndWhatBefellTheRunOnce) {
  stream_.add(spooled(domain::Intervention{4, 4, {"goal=1,2"}, {}, {}}));
  PageClient page(stream_, taker_);
  ASSERT_EQ(taker_.texts.size(), 2U);
  EXPECT_EQ(taker_.texts[1]["changes"].dump(), R"([{"changes":["goal=1,2"],"order":"","tick":4}])");

  stream_.add(spooled(domain::Incident{7, "restart", "drive", "gone; restarting it"}));
  stream_.pass_on();
  stream_.pass_on();

  ASSERT_EQ(taker_.texts.size(), 3U);
  EXPECT_EQ(taker_.texts[2]["changes"], nlohmann::json::array());
  EXPECT_EQ(taker_.texts[2]["incidents"][0]["kind"], "restart");
  EXPECT_EQ(taker_.texts[2]["incidents"][0]["stage"], "drive");
}

TEST_F(ALiveStream, HasATickWhenEachTopicHasIt) {
  stream_.add(record(Topic::kState, 0));
  EXPECT_FALSE(stream_.newest());

  stream_.add(record(Topic::kScan, 0));
  ASSERT_TRUE(stream_.newest());
  EXPECT_EQ(*stream_.newest()->records, whole_tick(0));
}

TEST_F(ALiveStream, PassesOverWhatARestartedComponentWritesAgain) {
  stream_.add(whole_tick(0) + whole_tick(1));
  stream_.add(record(Topic::kState, 0) + record(Topic::kState, 1));

  EXPECT_EQ(*stream_.tick_from(0)->records, whole_tick(0));
}

TEST_F(ALiveStream, ForgetsTheOldestTickWhenItHoldsTooMuch) {
  for (std::uint64_t tick = 0; tick < 1000; ++tick) stream_.add(whole_tick(tick));

  // A tick is two records of 24 + 5 bytes: 129 of them are 7482 bytes; a quarter is for states.
  EXPECT_EQ(stream_.tick_from(0)->number, 1000U - 129U);
  EXPECT_EQ(stream_.newest()->number, 999U);
}

TEST_F(ALiveStream, SaysWhenWhatItGetsIsNoSpool) { EXPECT_FALSE(stream_.add("rubbish")); }

TEST_F(ALiveStream, GivesALatecomerAllThatItHoldsAndThenTheNewest) {
  stream_.add(whole_tick(0) + whole_tick(1));

  PageClient page(stream_, taker_);
  ASSERT_EQ(taker_.sent.size(), 1U);
  EXPECT_EQ(taker_.sent[0], whole_tick(0) + whole_tick(1));

  stream_.add(whole_tick(2) + whole_tick(3));
  stream_.pass_on();
  EXPECT_EQ(taker_.sent[1], whole_tick(3));
}

TEST_F(ALiveStream, GivesAllTicksToAViewerThatAsksForThem) {
  PageClient page(stream_, taker_);
  page.receive_text(R"({"all": true})");

  stream_.add(whole_tick(0) + whole_tick(1));
  stream_.pass_on();
  EXPECT_EQ(taker_.sent.back(), whole_tick(0) + whole_tick(1));
}

TEST_F(ALiveStream, GivesASlowViewerNothingNewAndTellsHowMuchItMissed) {
  PageClient page(stream_, taker_);
  taker_.queued = std::size_t{1} << 30;
  stream_.add(whole_tick(0) + whole_tick(1));
  stream_.pass_on();
  EXPECT_TRUE(taker_.sent.empty());

  taker_.queued = 0;
  stream_.end("reached");
  EXPECT_EQ(taker_.sent.size(), 1U);
  EXPECT_EQ(taker_.texts[1]["missed"], 1);
  EXPECT_EQ(taker_.texts[2]["ended"], "reached");
}

TEST_F(ALiveStream, TellsTheEndBehindAllThatAClientIsToGet) {
  PageClient page(stream_, taker_);
  taker_.queued = std::size_t{1} << 30;
  stream_.add(whole_tick(0) + whole_tick(1));
  stream_.end("reached");
  EXPECT_EQ(taker_.texts.size(), 1U);  // the description

  taker_.queued = 0;
  stream_.pass_on();
  ASSERT_EQ(taker_.texts.size(), 3U);
  EXPECT_EQ(taker_.texts[1]["missed"], 1);
  EXPECT_EQ(taker_.texts[2]["ended"], "reached");
  EXPECT_EQ(taker_.sent.size(), 1U);
  EXPECT_FALSE(page.idle());

  page.receive_text(R"({"has_all": true})");
  EXPECT_TRUE(page.idle());
}

TEST_F(ALiveStream, GivesEverythingAgainAfterTheEnd) {
  stream_.add(whole_tick(0) + whole_tick(1));
  stream_.end("reached");
  PageClient page(stream_, taker_);
  taker_.sent.clear();

  page.receive_text(R"({"all": true, "from": 0})");
  ASSERT_EQ(taker_.sent.size(), 1U);
  EXPECT_EQ(taker_.sent[0], whole_tick(0) + whole_tick(1));
}

TEST_F(ALiveStream, TakesRubbishFromAViewer) {
  PageClient page(stream_, taker_);
  for (const char* text : {"", "{", "[]", "7", R"({"from": -1})", R"({"from": "x", "all": 3})"}) {
    page.receive_text(text);
  }
  EXPECT_TRUE(taker_.sent.empty());
}

}  // namespace
}  // namespace clew::bridge
