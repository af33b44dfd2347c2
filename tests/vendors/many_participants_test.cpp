// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "recording_listeners.hpp"
#include "test_domain.hpp"
#include "vendors/participant_factory.hpp"

namespace clew::bridge {
namespace {

TEST(ManyParticipants, SixtyOfBothVendorsMatch) {
  constexpr std::size_t kCount = 60;
  TestDomain domain;
  const EndpointSpec spec{"scan", "clew::msg::Scan", "", 8};
  DiscoveryRecord writer_side;
  DiscoveryRecord reader_side;
  SampleRecord samples;
  std::vector<std::unique_ptr<Participant>> participants;
  std::vector<std::unique_ptr<SampleReader>> readers;
  auto source =
      create_participant(Vendor::kCycloneDds, {domain.number(), "source", 10.0}, writer_side);
  ASSERT_TRUE(source.ok()) << source.error().text();
  const auto writer = (*source)->create_writer(spec);
  ASSERT_TRUE(writer.ok());

  for (std::size_t i = 1; i < kCount; ++i) {
    const Vendor vendor = i % 2 == 0 ? Vendor::kCycloneDds : Vendor::kFastDds;
    auto participant = create_participant(vendor, {domain.number(), "sink", 10.0}, reader_side);
    ASSERT_TRUE(participant.ok()) << participant.error().text();
    participants.push_back(std::move(participant).value());
    auto reader = participants.back()->create_reader(spec, samples);
    ASSERT_TRUE(reader.ok()) << reader.error().text();
    readers.push_back(std::move(reader).value());
  }

  ASSERT_TRUE(writer_side.wait_for_matches(kCount - 1)) << writer_side.events().matched.size();
  ASSERT_TRUE(reader_side.wait_for_matches(kCount - 1)) << reader_side.events().matched.size();
  ASSERT_EQ((*writer)->write(std::string("\x00\x01\x00\x00", 4) + "data"), WriteStatus::kTaken);
  EXPECT_TRUE(samples.wait_for(kCount - 1)) << samples.samples().size();
}

}  // namespace
}  // namespace clew::bridge
