// SPDX-License-Identifier: Apache-2.0
/// Lists and texts whose bytes announce more than there may be, or than there is.
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

TEST(Length, RefusesAListBeyondItsBound) {
  domain::Scan scan;
  scan.range_max_m = 1.0;
  scan.ranges_m.assign(domain::kMaxRanges, 0.5);
  Codec<domain::Scan> codec;
  std::string bytes(codec.encode(scan));
  const std::uint32_t too_many = domain::kMaxRanges + 1;
  std::memcpy(&bytes[4 + 64], &too_many, sizeof too_many);

  const core::Result<void> result = codec.decode(bytes, scan);

  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(),
            "clew::msg::Scan, 16460 bytes: ranges_m is 2049 values long; allowed: at most 2048");
}

TEST(Length, RefusesAListThatItsBytesDoNotHoldWithoutMakingRoomForIt) {
  Codec<domain::Scan> codec;
  domain::Scan scan;
  std::string bytes(codec.encode(scan));
  const std::uint32_t many = domain::kMaxRanges;
  std::memcpy(&bytes[4 + 64], &many, sizeof many);

  const core::Result<void> result = codec.decode(bytes, scan);

  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(),
            "clew::msg::Scan, 72 bytes: too short for its content; it ends in ranges_m");
  EXPECT_EQ(scan.ranges_m.capacity(), 0U);
}

TEST(Length, RefusesAListOfBillionsWithoutMakingRoomForIt) {
  domain::Event event;
  Codec<domain::Event> codec;
  std::string bytes(codec.encode(event));
  const std::uint32_t billions = 0xFFFFFFFF;
  std::memcpy(&bytes[4 + 24], &billions, sizeof billions);

  EXPECT_FALSE(codec.decode(bytes, event).ok());
}

/// The CDR of Guidance whose `why` is `text`, with the length that CDR wants.
std::string cdr_of_guidance_because(const std::string& text) {
  Codec<domain::Guidance> codec;
  std::string bytes(codec.encode(domain::Guidance{}));
  bytes.resize(bytes.size() - 1);  // an empty text: its length, 1, and its end
  const auto length = static_cast<std::uint32_t>(text.size() + 1);
  std::memcpy(&bytes[bytes.size() - sizeof length], &length, sizeof length);
  return bytes + text + '\0';
}

TEST(Length, RefusesATextBeyondItsBound) {
  Codec<domain::Guidance> codec;
  domain::Guidance guidance;

  EXPECT_TRUE(codec.decode(cdr_of_guidance_because(std::string(96, 'w')), guidance).ok());
  const core::Result<void> result =
      codec.decode(cdr_of_guidance_because(std::string(97, 'w')), guidance);
  ASSERT_FALSE(result.ok());
  EXPECT_NE(result.error().text().find("why is 97 bytes long; allowed: at most 96"),
            std::string::npos);
}

TEST(Length, RefusesATextWithAZeroByteWithinOrWithoutOneAtItsEnd) {
  Codec<domain::Guidance> codec;
  domain::Guidance guidance;
  std::string endless = cdr_of_guidance_because("abc");
  endless.back() = 'd';
  std::string nothing = cdr_of_guidance_because("");
  nothing.resize(nothing.size() - 1);
  nothing[nothing.size() - 4] = '\0';  // a length of 0, which leaves no place for the zero byte

  for (const std::string& bytes :
       {cdr_of_guidance_because(std::string("a\0b", 3)), endless, nothing}) {
    const core::Result<void> result = codec.decode(bytes, guidance);

    ASSERT_FALSE(result.ok());
    EXPECT_NE(result.error().text().find("why has no zero byte at its end, or one before it"),
              std::string::npos)
        << result.error().text();
  }
}

}  // namespace
}  // namespace clew::bridge
