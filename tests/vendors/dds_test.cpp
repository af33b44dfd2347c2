// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <tuple>

#include "recording_listeners.hpp"
#include "test_domain.hpp"
#include "vendors/participant_factory.hpp"

namespace clew::bridge {
namespace {

constexpr int kDepth = 8;

EndpointSpec scan_spec(const std::string& user_data = "clew_idl=1;") {
  return {"scan", "clew::msg::Scan", user_data, kDepth};
}

/// A sample of `size` bytes whose content follows from `number`.
std::string numbered_sample(std::uint32_t number, std::size_t size) {
  std::string cdr("\x00\x01\x00\x00", 4);
  for (std::size_t i = 4; i < size; ++i) cdr += static_cast<char>(number >> (i % 4 * 8));
  return cdr;
}

std::unique_ptr<Participant> join(Vendor vendor, int domain, DiscoveryListener& discovery,
                                  const std::string& name = "test") {
  auto participant = create_participant(vendor, {domain, name, 1.5}, discovery);
  EXPECT_TRUE(participant.ok()) << participant.error().text();
  return std::move(participant).value();
}

/// Writes until the sample is taken: what every user of a writer does, from a thread that may wait.
void write_at_last(SampleWriter& writer, std::string_view cdr) {
  const auto give_up = std::chrono::steady_clock::now() + kPatience;
  WriteStatus status = writer.write(cdr);
  while (status == WriteStatus::kWouldBlock && std::chrono::steady_clock::now() < give_up) {
    status = writer.write(cdr);
  }
  ASSERT_EQ(status, WriteStatus::kTaken);
}

/// A writer and a reader, each with a participant of its own, of any two vendors.
class DdsPair : public testing::TestWithParam<std::tuple<Vendor, Vendor>> {
 protected:
  Vendor writer_vendor() const { return std::get<0>(GetParam()); }
  Vendor reader_vendor() const { return std::get<1>(GetParam()); }

  void join_both() {
    writer_participant_ = join(writer_vendor(), domain_.number(), writer_side_, "writer");
    reader_participant_ = join(reader_vendor(), domain_.number(), reader_side_, "reader");
  }
  void open_writer(const EndpointSpec& spec = scan_spec("clew_idl=w;")) {
    auto writer = writer_participant_->create_writer(spec);
    ASSERT_TRUE(writer.ok()) << writer.error().text();
    writer_ = std::move(writer).value();
  }
  void open_reader(const EndpointSpec& spec = scan_spec("clew_idl=r;")) {
    auto reader = reader_participant_->create_reader(spec, samples_);
    ASSERT_TRUE(reader.ok()) << reader.error().text();
    reader_ = std::move(reader).value();
  }
  void match() {
    join_both();
    open_writer();
    open_reader();
    ASSERT_TRUE(writer_side_.wait_for_matches(1));
    ASSERT_TRUE(reader_side_.wait_for_matches(1));
  }

  TestDomain domain_;
  DiscoveryRecord writer_side_;
  DiscoveryRecord reader_side_;
  SampleRecord samples_;
  std::unique_ptr<Participant> writer_participant_;
  std::unique_ptr<Participant> reader_participant_;
  std::unique_ptr<SampleWriter> writer_;
  std::unique_ptr<SampleReader> reader_;
};

std::string pair_name(const testing::TestParamInfo<std::tuple<Vendor, Vendor>>& info) {
  return std::string(vendor_name(std::get<0>(info.param))) + "_to_" +
         std::string(vendor_name(std::get<1>(info.param)));
}

INSTANTIATE_TEST_SUITE_P(AllVendors, DdsPair,
                         testing::Combine(testing::Values(Vendor::kCycloneDds, Vendor::kFastDds),
                                          testing::Values(Vendor::kCycloneDds, Vendor::kFastDds)),
                         pair_name);

TEST_P(DdsPair, CarriesBytesOfAnySizeExactly) {
  match();
  const std::vector<std::size_t> sizes = {5,    8,     63,    200,   1344,  1345,
                                          4096, 16389, 65000, 65536, 70001, 200000};
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const std::string sent = numbered_sample(static_cast<std::uint32_t>(i) * 77777, sizes[i]);

    write_at_last(*writer_, sent);

    ASSERT_TRUE(samples_.wait_for(i + 1)) << sizes[i] << " bytes did not arrive";
    const std::string received = samples_.samples()[i];
    EXPECT_EQ(received.substr(4, sent.size() - 4), sent.substr(4)) << sizes[i];
    EXPECT_EQ(received.substr(0, 2), sent.substr(0, 2));
    EXPECT_LE(received.size(), (sent.size() + 3) / 4 * 4);
  }
}

TEST_P(DdsPair, KeepsTheOrderOfManySamples) {
  match();
  for (std::uint32_t i = 0; i < 2000; ++i) write_at_last(*writer_, numbered_sample(i, 200));

  ASSERT_TRUE(samples_.wait_for(2000));

  const std::vector<std::string> received = samples_.samples();
  for (std::uint32_t i = 0; i < 2000; ++i) ASSERT_EQ(received[i], numbered_sample(i, 200)) << i;
}

TEST_P(DdsPair, EndpointsAreKnownToOthersByTheirGuids) {
  match();

  EXPECT_EQ(reader_side_.events().matched[0].guid, writer_->guid());
  EXPECT_EQ(writer_side_.events().matched[0].guid, reader_->guid());
  EXPECT_EQ(writer_->guid().size(), 32U);
  EXPECT_EQ(writer_->guid().substr(0, 24), writer_participant_->guid().substr(0, 24));
}

TEST_P(DdsPair, AKeepLastWriterIsHeldUpByNobody) {
  constexpr std::uint32_t kSamples = 500;
  join_both();
  EndpointSpec spec = scan_spec();
  spec.qos = {true, false, true};
  open_writer(spec);
  open_reader(spec);
  ASSERT_TRUE(writer_side_.wait_for_matches(1));
  ASSERT_TRUE(reader_side_.wait_for_matches(1));
  samples_.hold();

  for (std::uint32_t i = 0; i < kSamples; ++i) {
    ASSERT_EQ(writer_->write(numbered_sample(i, 200)), WriteStatus::kTaken) << i;
  }
  samples_.release();

  // Whatever was dropped on the way, the newest one is not.
  const auto give_up = std::chrono::steady_clock::now() + kPatience;
  const std::string last = numbered_sample(kSamples - 1, 200);
  for (std::size_t count = 1; samples_.samples().empty() || samples_.samples().back() != last;
       count = samples_.samples().size() + 1) {
    ASSERT_LT(std::chrono::steady_clock::now(), give_up);
    ASSERT_TRUE(samples_.wait_for(count));
  }
}

TEST_P(DdsPair, ABestEffortReaderHoldsUpNobody) {
  join_both();
  open_writer();
  EndpointSpec spec = scan_spec();
  spec.qos.reliable = false;
  spec.qos.transient_local = false;
  open_reader(spec);
  ASSERT_TRUE(writer_side_.wait_for_matches(1));
  ASSERT_TRUE(reader_side_.wait_for_matches(1));
  samples_.hold();

  for (std::uint32_t i = 0; i < 100 * kDepth; ++i) {
    ASSERT_EQ(writer_->write(numbered_sample(i, 200)), WriteStatus::kTaken) << i;
  }
  samples_.release();
  EXPECT_TRUE(samples_.wait_for(1));
}

TEST_P(DdsPair, GivesALateReaderTheEndOfThePast) {
  join_both();
  open_writer();
  for (std::uint32_t i = 0; i < 20; ++i) {
    ASSERT_EQ(writer_->write(numbered_sample(i, 40)), WriteStatus::kTaken);
  }

  open_reader();

  // The history of 8 holds samples 12 to 19.
  ASSERT_TRUE(samples_.wait_for(kDepth));
  write_at_last(*writer_, numbered_sample(20, 40));
  ASSERT_TRUE(samples_.wait_for(kDepth + 1));
  const std::vector<std::string> received = samples_.samples();
  ASSERT_EQ(received.size(), kDepth + 1u);
  for (std::uint32_t i = 0; i < received.size(); ++i) {
    EXPECT_EQ(received[i], numbered_sample(12 + i, 40));
  }
}

TEST_P(DdsPair, TellsEachSideOfTheOther) {
  match();

  const RemoteEndpoint reader = writer_side_.events().matched.at(0);
  EXPECT_FALSE(reader.is_writer);
  EXPECT_EQ(reader.topic, "scan");
  EXPECT_EQ(reader.type, "clew::msg::Scan");
  EXPECT_EQ(reader.user_data, "clew_idl=r;");
  EXPECT_EQ(reader.guid.size(), 32u);
  EXPECT_EQ(reader.process_id, getpid());
  const RemoteEndpoint writer = reader_side_.events().matched.at(0);
  EXPECT_TRUE(writer.is_writer);
  EXPECT_EQ(writer.user_data, "clew_idl=w;");
  EXPECT_EQ(writer.process_id, getpid());
}

TEST_P(DdsPair, TellsWhoWroteASample) {
  match();

  write_at_last(*writer_, numbered_sample(1, 40));

  ASSERT_TRUE(samples_.wait_for(1));
  EXPECT_EQ(samples_.writers().at(0), reader_side_.events().matched.at(0).guid);
}

TEST_P(DdsPair, TellsWhenAReaderIsGone) {
  match();

  reader_.reset();

  ASSERT_TRUE(writer_side_.wait_until([](const auto& e) { return e.unmatched.size() == 1; }));
  EXPECT_EQ(writer_side_.events().unmatched.at(0).user_data, "clew_idl=r;");
}

TEST_P(DdsPair, TellsWhenAWriterIsGone) {
  match();

  writer_.reset();

  ASSERT_TRUE(reader_side_.wait_until([](const auto& e) { return e.unmatched.size() == 1; }));
  EXPECT_EQ(reader_side_.events().unmatched.at(0).user_data, "clew_idl=w;");
}

TEST_P(DdsPair, DeliversWhatWasWrittenJustBeforeTheWriterClosed) {
  match();
  const std::string last = numbered_sample(1, 200000);

  ASSERT_EQ(writer_->write(last), WriteStatus::kTaken);
  writer_.reset();

  ASSERT_TRUE(samples_.wait_for(1));
  EXPECT_EQ(samples_.samples().at(0), last);
}

TEST_P(DdsPair, RefusesToOverwriteWhatASlowReaderHasNotTaken) {
  match();
  samples_.hold();
  std::uint32_t taken = 0;
  while (taken < 100000 && writer_->write(numbered_sample(taken, 1000)) == WriteStatus::kTaken) {
    ++taken;
  }
  ASSERT_LT(taken, 100000u) << "it never refused";
  ASSERT_GE(taken, static_cast<std::uint32_t>(kDepth));

  samples_.release();

  write_at_last(*writer_, numbered_sample(taken, 1000));
  ASSERT_TRUE(samples_.wait_for(taken + 1));
  const std::vector<std::string> received = samples_.samples();
  for (std::uint32_t i = 0; i <= taken; ++i) {
    ASSERT_EQ(received[i], numbered_sample(i, 1000)) << i << " of " << taken;
  }
}

TEST_P(DdsPair, ReportsAnotherTypeOnItsTopic) {
  join_both();
  open_writer();
  EndpointSpec other = scan_spec("clew_idl=other;");
  other.type = "somebody::Else";

  open_reader(other);

  const auto reported = [](const auto& e) { return e.inconsistent.size() == 1; };
  ASSERT_TRUE(writer_side_.wait_until(reported));
  ASSERT_TRUE(reader_side_.wait_until(reported));
  EXPECT_EQ(writer_side_.events().inconsistent.at(0).type, "somebody::Else");
  EXPECT_EQ(writer_side_.events().inconsistent.at(0).user_data, "clew_idl=other;");
  EXPECT_EQ(reader_side_.events().inconsistent.at(0).type, "clew::msg::Scan");
  EXPECT_TRUE(writer_side_.events().matched.empty());
}

TEST_P(DdsPair, DoesNotReachAnotherDomain) {
  TestDomain other_domain;
  DiscoveryRecord other_side;
  SampleRecord other_samples;
  const auto other = join(reader_vendor(), other_domain.number(), other_side);
  const auto other_reader = other->create_reader(scan_spec(), other_samples);
  ASSERT_TRUE(other_reader.ok());

  match();
  write_at_last(*writer_, numbered_sample(1, 40));
  ASSERT_TRUE(samples_.wait_for(1));

  EXPECT_TRUE(other_side.events().matched.empty());
  EXPECT_TRUE(other_samples.samples().empty());
}

TEST_P(DdsPair, KnowEachOtherByName) {
  join_both();

  const auto knows = [](DiscoveryRecord& side, const std::string& name) {
    return side.wait_until([&](const auto& events) { return events.participants.count(name) > 0; });
  };
  EXPECT_TRUE(knows(writer_side_, "reader"));
  EXPECT_TRUE(knows(reader_side_, "writer"));

  reader_participant_.reset();
  EXPECT_TRUE(writer_side_.wait_until(
      [](const auto& events) { return events.participants.count("reader") == 0; }));
}

TEST(Vendor, HasOneNameEach) {
  EXPECT_EQ(vendor_name(Vendor::kCycloneDds), "cyclonedds");
  EXPECT_EQ(vendor_from_name("fastdds"), Vendor::kFastDds);
  EXPECT_EQ(vendor_from_name("rti"), std::nullopt);
}

TEST(Participant, RefusesADomainWhosePortsBelongToOthers) {
  DiscoveryRecord discovery;
  for (const int domain : {-1, 100}) {
    const auto participant = create_participant(Vendor::kCycloneDds, {domain, "x", 1.5}, discovery);

    ASSERT_FALSE(participant.ok());
    EXPECT_EQ(participant.error().text(),
              "domain " + std::to_string(domain) + "; allowed: 0 to 99");
  }
}

}  // namespace
}  // namespace clew::bridge
