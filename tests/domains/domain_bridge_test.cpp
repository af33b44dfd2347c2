// SPDX-License-Identifier: Apache-2.0
#include "domains/domain_bridge.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "dds/origin.hpp"
#include "domain/messages.hpp"
#include "tests/component/fake_participant.hpp"
#include "wire/codec.hpp"

namespace clew::domains {
namespace {

using bridge::FakeParticipant;
using bridge::Origin;
using bridge::RemoteEndpoint;

constexpr char kType[] = "some::Type";

/// A participant that a bridge owns and a test speaks through.
struct Side {
  FakeParticipant* participant = nullptr;
  bridge::DiscoveryListener* ear = nullptr;
};

/// A bridge between domains a, b and c without a network.
class Bridged : public testing::Test {
 protected:
  void open(const std::string& topics) {
    auto file =
        read_bridge_file({"bridge.yaml",
                          "format: clew-bridge/1\ndomains: {a: {domain: 1}, b: {domain: 2}, c: "
                          "{domain: 3}}\ntopics:\n" +
                              topics});
    ASSERT_TRUE(file.ok()) << file.error().text();
    Surroundings surroundings;
    surroundings.tell = [this](const std::string& text) { told_.push_back(text); };
    surroundings.join =
        [this](
            std::size_t index, const bridge::ParticipantConfig& config,
            bridge::DiscoveryListener& ear) -> core::Result<std::unique_ptr<bridge::Participant>> {
      EXPECT_EQ(config.domain, static_cast<int>(index) + 1);
      auto fake = std::make_unique<FakeParticipant>();
      sides_[index].push_back({fake.get(), &ear});
      return std::unique_ptr<bridge::Participant>(std::move(fake));
    };
    auto made = DomainBridge::create(
        *file, {{"a", 1, false, "h-1"}, {"b", 2, false, "h-2"}, {"c", 3, false, "h-3"}},
        surroundings);
    ASSERT_TRUE(made.ok()) << made.error().text();
    bridge_ = std::move(made).value();
  }

  /// The participant that reads on a domain: who writes there was there first.
  Side& reads(std::size_t index) { return sides_[index].back(); }
  Side& writes(std::size_t index) { return sides_[index].front(); }

  RemoteEndpoint find(std::size_t index, const std::string& topic, bool reliable = true,
                      const std::string& user_data = "", const std::string& type = kType) {
    RemoteEndpoint writer;
    writer.is_writer = true;
    writer.topic = topic;
    writer.type = type;
    writer.user_data = user_data;
    writer.guid = "writer " + std::to_string(++writers_);
    writer.reliable = reliable;
    reads(index).ear->on_discovered(writer);
    bridge_->step();
    return writer;
  }
  void deliver(std::size_t index, const RemoteEndpoint& writer, const std::string& cdr) {
    reads(index).participant->deliver(writer.topic, cdr, &writer);
    bridge_->step();
  }

  std::map<std::size_t, std::vector<Side>> sides_;
  std::vector<std::string> told_;
  std::unique_ptr<DomainBridge> bridge_;
  int writers_ = 0;
};

using Texts = std::vector<std::string>;

TEST_F(Bridged, PassesBytesOfAnyTypeOnUnderAnotherName) {
  open("- {topic: scan, from: a, to: [b, c], as: r1/scan}\n");
  const RemoteEndpoint writer = find(0, "scan");

  deliver(0, writer, "one");
  deliver(0, writer, std::string("\0two", 4));

  EXPECT_EQ(writes(1).participant->written("r1/scan"), (Texts{"one", std::string("\0two", 4)}));
  EXPECT_EQ(writes(2).participant->written("r1/scan").size(), 2u);
  ASSERT_EQ(bridge_->passages().size(), 2u);
  EXPECT_EQ(bridge_->passages()[0].passed, 2u);
  EXPECT_EQ(told_.front(),
            "scan [some::Type] of a (domain 1) goes to b (domain 2) as r1/scan, reliable, "
            "volatile");
}

TEST_F(Bridged, CopiesTypeQosAndUserDataAndSaysWhereItComesFrom) {
  open("- {topic: scan, from: a, to: b, depth: 7}\n");

  find(0, "scan", false, "clew_idl=ab;clew_stage=sense;clew_seal=cd;");

  const auto writers = writes(1).participant->writers();
  ASSERT_EQ(writers.size(), 1u);
  EXPECT_EQ(writers[0].type, kType);
  EXPECT_FALSE(writers[0].qos.reliable);
  EXPECT_FALSE(writers[0].qos.transient_local);
  EXPECT_EQ(writers[0].history_depth, 7);
  EXPECT_EQ(writers[0].user_data, "clew_idl=ab;clew_origin=h-1;clew_hops=1;");
}

TEST_F(Bridged, PassesOnWhatOtherTopicsAndTypesAreNot) {
  open("- {topic: scan, from: a, to: b, type: other::Type}\n");

  find(0, "scan");
  find(0, "odometry");

  EXPECT_TRUE(writes(1).participant->writers().empty());
  EXPECT_TRUE(bridge_->passages().empty());
}

TEST_F(Bridged, DoesNotTakeBackWhatItWroteOrAnotherBridgeDid) {
  open("- {topic: scan, from: a, to: b}\n- {topic: scan, from: b, to: a}\n");
  // As another bridge would write on b what it has read on a.
  const RemoteEndpoint echo = find(1, "scan", true, Origin{"h-1", 1, {}}.to_text());

  deliver(1, echo, "sample");

  EXPECT_TRUE(writes(0).participant->written("scan").empty());
  ASSERT_EQ(bridge_->passages().size(), 1u);
  EXPECT_EQ(bridge_->passages()[0].refused, 1u);
  EXPECT_EQ(told_.back(),
            "scan [some::Type] of b (domain 2) does not go to a (domain 1): it has been there");
}

TEST_F(Bridged, DoesNotPassOnWhatWentThroughTooManyBridges) {
  open("- {topic: scan, from: a, to: b}\n");

  find(0, "scan", true, Origin{"h-9", Origin::kMostHops - 1, {}}.to_text());
  const RemoteEndpoint far = find(0, "scan", true, Origin{"h-9", Origin::kMostHops, {}}.to_text());
  deliver(0, far, "sample");

  const auto writers = writes(1).participant->writers();
  ASSERT_EQ(writers.size(), 1u);
  EXPECT_EQ(writers[0].user_data, "clew_origin=h-9;clew_hops=4;clew_via=h-1;");
  EXPECT_EQ(bridge_->passages()[0].refused, 1u);
}

TEST_F(Bridged, DoesNotPassOnToWhereItWasInBetween) {
  open("- {topic: scan, from: a, to: b}\n");

  find(0, "scan", true, Origin{"h-9", 2, {"h-2"}}.to_text());

  EXPECT_TRUE(writes(1).participant->writers().empty());
}

TEST_F(Bridged, FiltersByFieldsOfTypesThatItKnows) {
  open("- {topic: odometry, from: a, to: b, where: [stamp.tick >= 2, blocked == false]}\n");
  const RemoteEndpoint writer = find(0, "odometry", true, "", "clew::msg::Odometry");
  bridge::Codec<domain::Odometry> codec;
  domain::Odometry odometry;

  for (const std::uint64_t tick : {1u, 2u, 3u}) {
    odometry.stamp.tick = tick;
    odometry.blocked = tick == 3;
    deliver(0, writer, std::string(codec.encode(odometry)));
  }
  deliver(0, writer, "no message");

  EXPECT_EQ(bridge_->passages()[0].passed, 1u);
  EXPECT_EQ(bridge_->passages()[0].filtered, 2u);
  EXPECT_EQ(bridge_->passages()[0].unreadable, 1u);
}

TEST_F(Bridged, RefusesToFilterATypeThatItDoesNotKnow) {
  open("- {topic: scan, from: a, to: b, where: stamp.tick >= 2}\n");

  const RemoteEndpoint writer = find(0, "scan");
  deliver(0, writer, "sample");

  EXPECT_TRUE(writes(1).participant->writers().empty());
  EXPECT_EQ(bridge_->passages()[0].refused, 1u);
  EXPECT_NE(told_.back().find("the fields of some::Type are unknown"), std::string::npos);
}

TEST_F(Bridged, ThinsToARate) {
  // One in an hour: all but the first are too early, however slow this test is.
  open("- {topic: scan, from: a, to: b, rate_hz: 0.0003}\n");
  const RemoteEndpoint writer = find(0, "scan");

  for (int i = 0; i < 5; ++i) deliver(0, writer, "sample");

  EXPECT_EQ(bridge_->passages()[0].passed, 1u);
  EXPECT_EQ(bridge_->passages()[0].thinned, 4u);
}

TEST_F(Bridged, KeepsTheOrderBehindASlowReader) {
  open("- {topic: scan, from: a, to: b}\n");
  const RemoteEndpoint writer = find(0, "scan");

  writes(1).participant->answer(bridge::WriteStatus::kWouldBlock);
  deliver(0, writer, "one");
  deliver(0, writer, "two");
  EXPECT_TRUE(bridge_->waits());
  EXPECT_EQ(bridge_->passages()[0].passed, 0u);
  writes(1).participant->answer(bridge::WriteStatus::kTaken);
  deliver(0, writer, "three");

  EXPECT_EQ(writes(1).participant->written("scan"), (Texts{"one", "two", "three"}));
  EXPECT_EQ(bridge_->passages()[0].passed, 3u);
  EXPECT_FALSE(bridge_->waits());
}

TEST_F(Bridged, CountsWhatASlowReaderDoesNotGetAndWhatAWriterDoesNotTake) {
  open("- {topic: scan, from: a, to: b}\n");
  const RemoteEndpoint writer = find(0, "scan");
  const std::string half(Outlet::kMostBytes / 2, 'x');

  writes(1).participant->answer(bridge::WriteStatus::kWouldBlock);
  for (int i = 0; i < 3; ++i) deliver(0, writer, half);
  EXPECT_EQ(bridge_->passages()[0].dropped, 1u);
  writes(1).participant->answer(bridge::WriteStatus::kFailed);
  bridge_->step();

  EXPECT_EQ(bridge_->passages()[0].failed, 2u);
}

TEST_F(Bridged, TakesEachSampleOnceWhereReadersOverlap) {
  open("- {topic: scan, from: a, to: b}\n");
  const RemoteEndpoint strict = find(0, "scan", true);
  // The fake hands samples to the reader that was made last: the one of best effort.
  find(0, "scan", false);

  deliver(0, strict, "sample");

  EXPECT_EQ(bridge_->passages()[0].passed, 0u);
}

TEST_F(Bridged, ReadsWithBestEffortIfTheFileSaysSo) {
  open("- {topic: scan, from: a, to: b, reliability: best_effort}\n");
  const RemoteEndpoint writer = find(0, "scan", true);

  deliver(0, writer, "sample");

  EXPECT_EQ(bridge_->passages()[0].passed, 1u);
  EXPECT_FALSE(writes(1).participant->writers()[0].qos.reliable);
}

TEST_F(Bridged, CountsSamplesOfWritersThatNobodyKnows) {
  open("- {topic: scan, from: a, to: b}\n");
  find(0, "scan");

  reads(0).participant->deliver("scan", "sample", nullptr);
  bridge_->step();

  EXPECT_EQ(bridge_->unknown(), 1u);
  EXPECT_EQ(bridge_->passages()[0].passed, 0u);
}

TEST_F(Bridged, TakesAWriterFromItsSampleIfDiscoveryIsLate) {
  open("- {topic: scan, from: a, to: b}\n");
  const RemoteEndpoint first = find(0, "scan");
  RemoteEndpoint second = first;
  second.guid = "not told of yet";

  deliver(0, second, "sample");
  reads(0).ear->on_discovered(second);
  bridge_->step();

  EXPECT_EQ(bridge_->passages()[0].passed, 1u);
  EXPECT_EQ(writes(1).participant->writers().size(), 1u);
}

TEST_F(Bridged, MakesAWriterAnewForWhoComesBack) {
  open("- {topic: scan, from: a, to: b}\n");
  const RemoteEndpoint writer = find(0, "scan");

  reads(0).ear->on_lost(writer);
  bridge_->step();
  find(0, "scan");

  EXPECT_EQ(writes(1).participant->writers().size(), 2u);
}

}  // namespace
}  // namespace clew::domains
