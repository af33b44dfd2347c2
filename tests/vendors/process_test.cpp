// SPDX-License-Identifier: Apache-2.0
/// The bridge between two processes, and when one of them dies.
#include <gtest/gtest.h>

#include <cstdlib>
#include <tuple>

#include "echo_process.hpp"
#include "recording_listeners.hpp"
#include "test_domain.hpp"

namespace clew::bridge {
namespace {

class TwoProcesses : public testing::TestWithParam<std::tuple<Vendor, Vendor>> {
 protected:
  void SetUp() override {
    auto participant =
        create_participant(std::get<0>(GetParam()), {domain_.number(), "test", 1.5}, discovery_);
    ASSERT_TRUE(participant.ok()) << participant.error().text();
    participant_ = std::move(participant).value();
    auto writer = participant_->create_writer({"question", "clew::msg::Test", "", 256});
    auto reader = participant_->create_reader({"answer", "clew::msg::Test", "", 256}, samples_);
    ASSERT_TRUE(writer.ok() && reader.ok());
    writer_ = std::move(writer).value();
    reader_ = std::move(reader).value();
  }
  std::unique_ptr<EchoProcess> start_echo() {
    return std::make_unique<EchoProcess>(std::get<1>(GetParam()), domain_.number());
  }
  static std::string question(int number) {
    return std::string("\x00\x01\x00\x00", 4) + "question " + std::to_string(1000 + number) + "...";
  }

  TestDomain domain_;
  DiscoveryRecord discovery_;
  SampleRecord samples_;
  std::unique_ptr<Participant> participant_;
  std::unique_ptr<SampleWriter> writer_;
  std::unique_ptr<SampleReader> reader_;
};

INSTANTIATE_TEST_SUITE_P(AllVendors, TwoProcesses,
                         testing::Combine(testing::Values(Vendor::kCycloneDds, Vendor::kFastDds),
                                          testing::Values(Vendor::kCycloneDds, Vendor::kFastDds)),
                         [](const auto& instance) {
                           return std::string(vendor_name(std::get<0>(instance.param))) + "_with_" +
                                  std::string(vendor_name(std::get<1>(instance.param)));
                         });

TEST_P(TwoProcesses, AnswerEachOther) {
  const auto echo = start_echo();
  ASSERT_TRUE(discovery_.wait_for_matches(2));
  EXPECT_EQ(discovery_.events().matched.at(0).process_id, echo->pid());

  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(writer_->write(question(i)), WriteStatus::kTaken);
    ASSERT_TRUE(samples_.wait_for(static_cast<std::size_t>(i) + 1));
    EXPECT_EQ(samples_.samples().back(), question(i));
  }

  EXPECT_EQ(echo->end(), 0);
}

TEST_P(TwoProcesses, StayOnLoopbackWhateverTheEnvironmentSays) {
  // Each alone would keep the echo away from this domain.
  setenv("ROS_DISCOVERY_SERVER", "127.0.0.1:11811", 1);
  setenv("CYCLONEDDS_URI", "<Discovery><ExternalDomainId>100</ExternalDomainId></Discovery>", 1);
  const auto echo = start_echo();
  unsetenv("ROS_DISCOVERY_SERVER");
  unsetenv("CYCLONEDDS_URI");

  EXPECT_TRUE(discovery_.wait_for_matches(2));
}

TEST_P(TwoProcesses, NoticeTheDeathOfOneWithinItsLease) {
  auto echo = start_echo();
  ASSERT_TRUE(discovery_.wait_for_matches(2));

  const auto death = std::chrono::steady_clock::now();
  echo->kill_it();

  ASSERT_TRUE(discovery_.wait_until([](const auto& e) { return e.unmatched.size() == 2; }));
  // A lease of 1.5 s, and as much again for a loaded machine.
  EXPECT_LT(std::chrono::steady_clock::now() - death, std::chrono::seconds(3));
}

TEST_P(TwoProcesses, GiveASuccessorTheHistory) {
  auto echo = start_echo();
  ASSERT_TRUE(discovery_.wait_for_matches(2));
  ASSERT_EQ(writer_->write(question(0)), WriteStatus::kTaken);
  ASSERT_TRUE(samples_.wait_for(1));
  echo->kill_it();
  ASSERT_EQ(writer_->write(question(1)), WriteStatus::kTaken);

  const auto successor = start_echo();

  // The successor answers both questions anew: the history is kept for it.
  ASSERT_TRUE(samples_.wait_for(3));
  EXPECT_EQ(samples_.samples().at(1), question(0));
  EXPECT_EQ(samples_.samples().at(2), question(1));
}

}  // namespace
}  // namespace clew::bridge
