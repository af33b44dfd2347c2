// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <tuple>

#include "recording_listeners.hpp"
#include "security/run_security.hpp"
#include "test_domain.hpp"
#include "vendors/participant_factory.hpp"

namespace clew::bridge {
namespace {

const std::string kSecret("\x00\x01\x00\x00secret..", 12);
const std::string kForged(
    "\x00\x01\x00\x00"
    "forged..",
    12);

EndpointSpec spec_of(const std::string& topic) {
  return {topic, "clew::msg::Scan", "clew_idl=1;", 8};
}

RunSecurity::Shared mint_pair() {
  const std::vector<Vendor> both = {Vendor::kCycloneDds, Vendor::kFastDds};
  const auto minted =
      RunSecurity::mint({{"writer", both, {{"scan"}, {}}}, {"reader", both, {{}, {"scan"}}}});
  EXPECT_TRUE(minted.ok()) << minted.error().text();
  return *minted;
}

/// A participant with what it is told.
struct Peer {
  DiscoveryRecord discovery;
  SampleRecord samples;
  std::unique_ptr<Participant> participant;
  std::unique_ptr<SampleWriter> writer;
  std::unique_ptr<SampleReader> reader;

  void join(Vendor vendor, int domain, const std::string& name,
            const std::optional<SecurityFiles>& security) {
    auto joined = create_participant(vendor, {domain, name, 1.5, {}, false, security}, discovery);
    ASSERT_TRUE(joined.ok()) << joined.error().text();
    participant = std::move(joined).value();
  }
  void write_scans() {
    auto created = participant->create_writer(spec_of("scan"));
    ASSERT_TRUE(created.ok()) << created.error().text();
    writer = std::move(created).value();
  }
  void read_scans() {
    auto created = participant->create_reader(spec_of("scan"), samples);
    ASSERT_TRUE(created.ok()) << created.error().text();
    reader = std::move(created).value();
  }
};

class SecuredPair : public testing::TestWithParam<std::tuple<Vendor, Vendor>> {
 protected:
  Vendor writer_vendor() const { return std::get<0>(GetParam()); }
  Vendor reader_vendor() const { return std::get<1>(GetParam()); }

  void open_pair() {
    writer_.join(writer_vendor(), domain_.number(), "writer",
                 security_->files("writer", writer_vendor()));
    reader_.join(reader_vendor(), domain_.number(), "reader",
                 security_->files("reader", reader_vendor()));
    writer_.write_scans();
    reader_.read_scans();
    ASSERT_TRUE(writer_.discovery.wait_for_matches(1));
    ASSERT_TRUE(reader_.discovery.wait_for_matches(1));
  }

  /// Two strangers of both vendors meet each other, and so have met whom they can meet.
  void expect_that_strangers_learn_nothing(const RunSecurity::Shared& of_strangers) {
    Peer listener;
    Peer forger;
    const auto identity = [&](const char* name, Vendor vendor) {
      return of_strangers ? std::optional(of_strangers->files(name, vendor)) : std::nullopt;
    };
    listener.join(reader_vendor(), domain_.number(), "listener",
                  identity("reader", reader_vendor()));
    forger.join(writer_vendor(), domain_.number(), "forger", identity("writer", writer_vendor()));
    listener.read_scans();
    forger.write_scans();
    ASSERT_TRUE(listener.discovery.wait_for_matches(1));
    ASSERT_TRUE(forger.discovery.wait_for_matches(1));

    ASSERT_EQ(forger.writer->write(kForged), WriteStatus::kTaken);
    ASSERT_EQ(writer_.writer->write(kSecret), WriteStatus::kTaken);
    ASSERT_TRUE(listener.samples.wait_for(1));
    ASSERT_TRUE(reader_.samples.wait_for(2));

    EXPECT_EQ(listener.samples.samples(), std::vector<std::string>{kForged});
    EXPECT_EQ(reader_.samples.samples(), (std::vector<std::string>{kSecret, kSecret}));
    EXPECT_EQ(listener.discovery.events().matched.size(), 1u);
    EXPECT_EQ(forger.discovery.events().matched.size(), 1u);
    EXPECT_EQ(writer_.discovery.events().matched.size(), 1u);
    EXPECT_EQ(reader_.discovery.events().matched.size(), 1u);
  }

  const RunSecurity::Shared security_ = mint_pair();
  TestDomain domain_;
  Peer writer_;
  Peer reader_;
};

TEST_P(SecuredPair, ExchangesSamplesThatStrangersNeitherSeeNorForge) {
  open_pair();
  ASSERT_EQ(writer_.writer->write(kSecret), WriteStatus::kTaken);
  ASSERT_TRUE(reader_.samples.wait_for(1));

  expect_that_strangers_learn_nothing(nullptr);
}

TEST_P(SecuredPair, DoesNotKnowTheIdentitiesOfAnotherAuthority) {
  open_pair();
  ASSERT_EQ(writer_.writer->write(kSecret), WriteStatus::kTaken);
  ASSERT_TRUE(reader_.samples.wait_for(1));

  expect_that_strangers_learn_nothing(mint_pair());
}

INSTANTIATE_TEST_SUITE_P(Vendors, SecuredPair,
                         testing::Combine(testing::Values(Vendor::kCycloneDds, Vendor::kFastDds),
                                          testing::Values(Vendor::kCycloneDds, Vendor::kFastDds)),
                         [](const auto& pair) {
                           return std::string(vendor_name(std::get<0>(pair.param))) + "_to_" +
                                  std::string(vendor_name(std::get<1>(pair.param)));
                         });

class Secured : public testing::TestWithParam<Vendor> {};

TEST_P(Secured, ParticipantGetsNoEndpointThatItHasNoRightTo) {
  const auto security = mint_pair();
  const TestDomain domain;
  Peer peer;
  peer.join(GetParam(), domain.number(), "writer", security->files("writer", GetParam()));

  EXPECT_TRUE(peer.participant->create_writer(spec_of("scan")).ok());
  EXPECT_FALSE(peer.participant->create_writer(spec_of("command")).ok());
  EXPECT_FALSE(peer.participant->create_reader(spec_of("scan"), peer.samples).ok());
}

TEST_P(Secured, ParticipantIsNotCreatedWithPermissionsThatWereChanged) {
  const auto security = mint_pair();
  const TestDomain domain;
  DiscoveryRecord discovery;
  SecurityFiles files = security->files("writer", GetParam());
  std::ifstream stream(files.permissions);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  const auto at = text.find("<topic>scan<");
  ASSERT_NE(at, std::string::npos) << text;
  const MemoryFile changed("changed", text.replace(at, 12, "<topic>goal<"));
  files.permissions = changed.path();

  const auto joined =
      create_participant(GetParam(), {domain.number(), "writer", 1.5, {}, false, files}, discovery);

  EXPECT_FALSE(joined.ok());
}

INSTANTIATE_TEST_SUITE_P(Vendors, Secured, testing::Values(Vendor::kCycloneDds, Vendor::kFastDds),
                         [](const auto& vendor) { return std::string(vendor_name(vendor.param)); });

}  // namespace
}  // namespace clew::bridge
