// SPDX-License-Identifier: Apache-2.0
#include "component/start_barrier.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "fake_participant.hpp"
#include "line/user_data.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using Texts = std::vector<std::string>;

std::string data_of(const std::string& stage) {
  return UserData{std::string(idl_fingerprint()), stage}.to_text();
}

RemoteEndpoint endpoint(bool is_writer, const std::string& topic, const std::string& stage) {
  return remote(is_writer, topic, stage, data_of(stage));
}

class Barrier : public testing::Test {
 protected:
  StartBarrier make(std::vector<ExpectedEndpoint> expected) {
    return {"control",
            std::move(expected),
            {[this] { ++changes_; }, [this](std::string text) { refused_.push_back(text); },
             [this](std::string text) { fatal_.push_back(text); },
             [this](std::string text) { readers_.push_back(text); }}};
  }

  int changes_ = 0;
  Texts refused_;
  Texts fatal_;
  Texts readers_;
};

TEST_F(Barrier, NamesWhatIsMissingUntilItIsMatched) {
  StartBarrier barrier = make({{"scan", true, "sense", false}, {"command", false, "drive", false}});

  EXPECT_EQ(barrier.missing(), (Texts{"control has not found the writer of 'scan' in sense",
                                      "control has not found the reader of 'command' in drive"}));
  barrier.on_matched(endpoint(true, "scan", "sense"));
  barrier.on_matched(endpoint(false, "command", "drive"));
  EXPECT_EQ(barrier.missing(), Texts{});
  EXPECT_EQ(changes_, 2);

  barrier.on_unmatched(endpoint(true, "scan", "sense"));
  EXPECT_EQ(barrier.missing(), Texts{"control has not found the writer of 'scan' in sense"});
}

TEST_F(Barrier, AcceptsOnlyTheExpectedWriterWhileItIsMatched) {
  StartBarrier barrier = make({{"scan", true, "sense", false}});
  const RemoteEndpoint sense = endpoint(true, "scan", "sense");
  const RemoteEndpoint stranger = endpoint(true, "scan", "recover");

  EXPECT_FALSE(barrier.accepts(&sense));
  EXPECT_FALSE(barrier.accepts(nullptr));
  const auto before = barrier.version();
  barrier.on_matched(sense);
  barrier.on_matched(stranger);

  EXPECT_TRUE(barrier.accepts(&sense));
  EXPECT_FALSE(barrier.accepts(&stranger));
  EXPECT_NE(barrier.version(), before);
  EXPECT_EQ(refused_, Texts{"control refuses the writer of 'scan' in recover: the graph has no "
                            "such writer"});
  barrier.on_unmatched(sense);
  EXPECT_FALSE(barrier.accepts(&sense));
}

TEST_F(Barrier, RefusesWhatWasBuiltFromOtherIdl) {
  StartBarrier barrier = make({{"scan", true, "sense", false}});

  barrier.on_matched(remote(true, "scan", "sense", "clew_idl=00;clew_stage=sense;"));
  barrier.on_matched(remote(true, "scan", "sense", "nothing"));

  ASSERT_EQ(refused_.size(), 2u);
  EXPECT_NE(refused_[0].find("other IDL files: its fingerprint is 00"), std::string::npos);
  EXPECT_NE(refused_[1].find("has no clew_idl=<fingerprint>;"), std::string::npos);
  EXPECT_EQ(barrier.missing().size(), 1u);
}

TEST_F(Barrier, TakesTheFirstWriterOfAThirdPartyAndNoOther) {
  StartBarrier barrier = make({{"scan", true, "sense", true}});
  const RemoteEndpoint first = remote(true, "scan", "", data_of(""), "first");
  const RemoteEndpoint second = remote(true, "scan", "", data_of(""), "second");

  barrier.on_matched(first);
  barrier.on_matched(second);

  EXPECT_TRUE(barrier.accepts(&first));
  EXPECT_FALSE(barrier.accepts(&second));
  EXPECT_EQ(refused_, Texts{"control refuses the writer of 'scan': there is one already"});
}

TEST_F(Barrier, DemandsTheSealOfTheRunFromWhoSaysThatHeIsAStage) {
  StartBarrier barrier = make({{"scan", true, "sense", false}, {"command", false, "drive", false}});
  const RunKey key = RunKey::make();
  barrier.demand_seals(key);
  const std::string guid(32, '1');
  const std::string other(32, '2');
  const std::string sealed = key.sealed(UserData::parse(data_of("sense")), guid).to_text();

  barrier.on_matched({true, "scan", "", data_of("sense"), other, 0});
  barrier.on_matched({true, "scan", "", sealed, other, 0});
  barrier.on_matched({false, "command", "", data_of("drive"), other, 0});
  EXPECT_EQ(barrier.missing().size(), 2u);
  EXPECT_EQ(refused_, Texts({"control refuses the writer of 'scan' in sense: it says that it is of "
                             "sense, but has not the seal of this run",
                             "control refuses the writer of 'scan' in sense: it says that it is of "
                             "sense, but has not the seal of this run",
                             "control refuses the reader of 'command' in drive: it says that it is "
                             "of drive, but has not the seal of this run"}));

  const RemoteEndpoint sense{true, "scan", "", sealed, guid, 0};
  barrier.on_matched(sense);
  EXPECT_TRUE(barrier.accepts(&sense));
}

TEST_F(Barrier, LetsNoStrangerEndARunByWhatHeAsksFor) {
  StartBarrier barrier = make({{"scan", true, "sense", true}, {"command", false, "drive", false}});

  barrier.on_incompatible_qos("command", true, "DURABILITY");
  EXPECT_EQ(fatal_, Texts{});
  EXPECT_EQ(refused_, Texts{"a reader of 'command' does not match the writer in control: "
                            "incompatible QoS policy DURABILITY; expected RELIABLE, "
                            "TRANSIENT_LOCAL, XCDR1; the history may be any"});

  // It has come already.
  barrier.on_matched(remote(true, "scan", "", data_of("")));
  barrier.on_incompatible_qos("scan", false, "RELIABILITY");
  EXPECT_EQ(fatal_, Texts{});
}

TEST_F(Barrier, NamesEveryReaderOfSomebodyElsesAndWaitsForNone) {
  StartBarrier barrier = make({{"command", false, "drive", false}});
  const RemoteEndpoint tool{false, "command", "", data_of(""), "tool", 7};
  const RemoteEndpoint other{false, "command", "", "nothing of clew's", "other", 8};

  barrier.on_matched(tool);
  barrier.on_matched(other);
  barrier.on_unmatched(tool);
  barrier.on_matched(endpoint(false, "command", "drive"));

  EXPECT_EQ(readers_, Texts({"somebody else listens: a reader of 'command' (process 7); nothing "
                             "waits for it",
                             "somebody else listens: a reader of 'command' (process 8); nothing "
                             "waits for it"}));
  EXPECT_EQ(refused_, Texts{});
  EXPECT_EQ(barrier.missing(), Texts{});
  EXPECT_EQ(changes_, 1) << "only drive is of the run";
}

TEST_F(Barrier, TakesTheFirstReaderOfAThirdPartyForItsOwn) {
  StartBarrier barrier = make({{"scan", false, "control", true}});

  barrier.on_matched({false, "scan", "", data_of(""), "own", 7});
  barrier.on_matched({false, "scan", "", data_of(""), "second", 8});

  EXPECT_EQ(barrier.missing(), Texts{});
  EXPECT_EQ(readers_, Texts{"somebody else listens: a reader of 'scan' (process 8); nothing waits "
                            "for it"});
}

TEST_F(Barrier, SaysWhichPolicyKeepsEndpointsApart) {
  StartBarrier barrier = make({{"scan", true, "sense", true}});

  barrier.on_incompatible_qos("scan", false, "RELIABILITY");
  barrier.on_inconsistent_type({true, "scan", "Other", data_of("sense"), "guid", 7});

  EXPECT_EQ(fatal_, Texts{"a writer of 'scan' does not match the reader in control: incompatible "
                          "QoS policy RELIABILITY; expected RELIABLE, TRANSIENT_LOCAL, XCDR1; the "
                          "history may be any"});
  EXPECT_EQ(refused_, Texts{"control refuses the writer of 'scan' in sense (process 7): it uses "
                            "type Other"});
}

TEST_F(Barrier, WaitsForParticipantsUntilTheLastIsKnown) {
  const auto late = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  StartBarrier barrier = make({});
  barrier.on_participants({"sense"});
  std::thread discovery([&] { barrier.on_participants({"control", "drive", "sense"}); });

  EXPECT_TRUE(barrier.wait_for_participants({"sense", "drive"}, late));

  discovery.join();
}

TEST_F(Barrier, WaitsForParticipantsNoLongerThanItMay) {
  StartBarrier barrier = make({});
  barrier.on_participants({"sense", "drive"});
  barrier.on_participants({"sense"});

  EXPECT_FALSE(barrier.wait_for_participants({"sense", "drive"}, std::chrono::steady_clock::now()));
  EXPECT_TRUE(barrier.wait_for_participants({}, std::chrono::steady_clock::now()));
}

}  // namespace
}  // namespace clew::bridge
