// SPDX-License-Identifier: Apache-2.0
#include "wire/codec.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "all_messages.hpp"
#include "clew/idl_fingerprint.h"
#include "message_equality.hpp"
#include "random_messages.hpp"

namespace clew::bridge {
namespace {

/// A test for each message.
template <typename Message>
class CodecOf : public testing::Test {};
TYPED_TEST_SUITE(CodecOf, AllMessages);

template <typename Value>
void put(std::string& bytes, Value value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

/// Byte by byte what the CDR of a State is: 8-byte numbers aligned to 8, counted from behind the
/// header; the enumeration as 4 bytes, the boolean as 1, and 3 zeros before the next 4-byte number.
std::string cdr_of_state_by_hand() {
  std::string bytes("\x00\x01\x00\x00", 4);
  put<std::uint64_t>(bytes, 7);                     // stamp.tick
  put<double>(bytes, 2.1);                          // stamp.sim_time_s
  put<std::uint64_t>(bytes, 8);                     // stamp.sequence_number
  for (const double number : {1.0, -2.0, 0.5,       // pose_world_robot
                              0.4, -0.3, 12.25}) {  // speed_mps, turn_rate_radps, path_length_m
    put(bytes, number);
  }
  put<std::uint32_t>(bytes, 2);  // OUTCOME_COLLIDED
  bytes.append("\x01\x00\x00\x00", 4);
  put<std::uint32_t>(bytes, 3);
  put<std::uint32_t>(bytes, 4);
  put<std::uint32_t>(bytes, 5);
  return bytes;
}

domain::State state_of_those_bytes() {
  domain::State state;
  state.stamp = {7, 2.1, 8};
  state.pose_world_robot = {1.0, -2.0, 0.5};
  state.speed_mps = 0.4;
  state.turn_rate_radps = -0.3;
  state.path_length_m = 12.25;
  state.outcome = domain::Outcome::kCollided;
  state.command_late = true;
  state.collisions = 3;
  state.hit_by = 4;
  state.safety_stops = 5;
  return state;
}

TEST(Codec, WritesTheBytesThatCdrPrescribes) {
  Codec<domain::State> codec;

  const std::string_view bytes = codec.encode(state_of_those_bytes());

  EXPECT_EQ(bytes, cdr_of_state_by_hand());
}

TEST(Codec, ReadsTheBytesThatCdrPrescribes) {
  Codec<domain::State> codec;
  domain::State state;

  const core::Result<void> result = codec.decode(cdr_of_state_by_hand(), state);

  ASSERT_TRUE(result.ok()) << result.error().text();
  EXPECT_TRUE(state == state_of_those_bytes());
}

TYPED_TEST(CodecOf, GivesBackWhatItTook) {
  RandomMessages random(1);
  Codec<TypeParam> writer;
  Codec<TypeParam> reader;
  TypeParam received;
  for (int i = 0; i < 500; ++i) {
    TypeParam sent;
    random.fill(sent);

    const core::Result<void> result = reader.decode(writer.encode(sent), received);

    ASSERT_TRUE(result.ok()) << result.error().text();
    ASSERT_TRUE(received == sent) << "message " << i;
  }
}

TYPED_TEST(CodecOf, WritesTheSameBytesWhateverItWroteBefore) {
  RandomMessages random(2);
  Codec<TypeParam> used;
  for (int i = 0; i < 100; ++i) {
    TypeParam message;
    random.fill(message);
    Codec<TypeParam> fresh;

    EXPECT_EQ(used.encode(message), fresh.encode(message));
  }
}

TYPED_TEST(CodecOf, TakesTheDefaultMessage) {
  Codec<TypeParam> codec;
  TypeParam received;

  const core::Result<void> result = codec.decode(codec.encode(TypeParam{}), received);

  ASSERT_TRUE(result.ok()) << result.error().text();
  EXPECT_TRUE(received == TypeParam{});
}

TYPED_TEST(CodecOf, RefusesEveryTruncation) {
  RandomMessages random(3);
  Codec<TypeParam> codec;
  TypeParam message;
  random.fill(message);
  const std::string bytes(codec.encode(message));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(codec.decode(std::string_view(bytes).substr(0, size), message).ok()) << size;
  }
}

TYPED_TEST(CodecOf, TakesPaddingUpToThreeBytes) {
  RandomMessages random(4);
  Codec<TypeParam> codec;
  TypeParam message;
  random.fill(message);
  const std::string bytes(codec.encode(message));
  for (const std::size_t padding : {1u, 2u, 3u}) {
    TypeParam received;

    EXPECT_TRUE(codec.decode(bytes + std::string(padding, '\xAA'), received).ok());

    EXPECT_TRUE(received == message);
  }
  EXPECT_FALSE(codec.decode(bytes + std::string(4, '\0'), message).ok());
}

TYPED_TEST(CodecOf, SurvivesAnyChangedByte) {
  RandomMessages random(5);
  Codec<TypeParam> codec;
  TypeParam message;
  random.fill(message);
  const std::string good(codec.encode(message));
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(~bad[i]);

    const bool valid = codec.decode(bad, message).ok();
    if (valid) {
      EXPECT_TRUE(domain::validate(message).ok());
    }
    EXPECT_TRUE(codec.decode_unvalidated(bad, message).ok() || !valid);
  }
}

TYPED_TEST(CodecOf, RefusesAnotherEncapsulation) {
  Codec<TypeParam> codec;
  TypeParam message;
  std::string bytes(codec.encode(message));
  bytes[1] = '\x03';  // PL_CDR_LE

  const core::Result<void> result = codec.decode(bytes, message);

  ASSERT_FALSE(result.ok());
  EXPECT_NE(result.error().text().find("encapsulation 00 03; allowed: 00 01"), std::string::npos)
      << result.error().text();
}

TYPED_TEST(CodecOf, IgnoresTheOptionsOfTheEncapsulation) {
  Codec<TypeParam> codec;
  TypeParam message;
  std::string bytes(codec.encode(message));
  bytes[3] = '\x03';  // Cyclone counts padding bytes here

  EXPECT_TRUE(codec.decode(bytes, message).ok());
}

TEST(Codec, LeavesADefaultMessageAfterARefusal) {
  std::string bytes = cdr_of_state_by_hand();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::memcpy(&bytes[4 + 24], &nan, sizeof nan);  // pose_world_robot.x_m
  Codec<domain::State> codec;
  domain::State state = state_of_those_bytes();

  const core::Result<void> result = codec.decode(bytes, state);

  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(), "state: pose_world_robot.x_m is nan; allowed: finite numbers");
  EXPECT_TRUE(state == domain::State{});
}

TEST(Codec, NamesTheTypeAndTheSizeOfASampleThatIsTooShort) {
  Codec<domain::State> codec;
  domain::State state;

  const core::Result<void> result = codec.decode(cdr_of_state_by_hand().substr(0, 50), state);

  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(),
            "clew::msg::State, 50 bytes: too short for its content; it ends in "
            "pose_world_robot.heading_rad");
}

TEST(Codec, NamesTheLimitOfASampleThatIsTooLong) {
  Codec<domain::State> codec;
  domain::State state;

  const core::Result<void> result =
      codec.decode(cdr_of_state_by_hand() + std::string(1000, '\0'), state);

  ASSERT_FALSE(result.ok());
  // 4 of header, 80 up to the enumeration and the padded boolean, three numbers of 4.
  EXPECT_EQ(result.error().text(), "clew::msg::State, 1096 bytes: too long; allowed: at most 96");
}

TEST(Codec, NamesTheEndOfTheContentOfASampleThatIsTooLongForIt) {
  Codec<domain::Scan> codec;
  domain::Scan scan;
  const std::string bytes = std::string(codec.encode(scan)) + std::string(8, '\0');

  const core::Result<void> result = codec.decode(bytes, scan);

  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(),
            "clew::msg::Scan, 80 bytes: too long; its content ends after 72");
}

TEST(Codec, SaysThatASampleIsTooShortBeforeItJudgesTheValuesInIt) {
  std::string bytes = cdr_of_state_by_hand();
  bytes[4 + 73] = '\x01';  // outcome 256 + 2
  bytes[4 + 76] = '\x02';  // command_late
  Codec<domain::State> codec;
  domain::State state;

  const core::Result<void> whole = codec.decode(bytes, state);
  const core::Result<void> cut = codec.decode(bytes.substr(0, 88), state);

  ASSERT_FALSE(whole.ok() || cut.ok());
  EXPECT_EQ(whole.error().text(), "clew::msg::State, 96 bytes: outcome is 258; allowed: at most 4");
  EXPECT_EQ(cut.error().text(),
            "clew::msg::State, 88 bytes: too short for its content; it ends in hit_by");
}

TEST(Codec, RefusesAnEnumeratorThatFitsAByteOnlyWhenCut) {
  std::string bytes = cdr_of_state_by_hand();
  const std::uint32_t outcome = 256;
  std::memcpy(&bytes[4 + 72], &outcome, sizeof outcome);
  Codec<domain::State> codec;
  domain::State state;

  const core::Result<void> result = codec.decode(bytes, state);

  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(),
            "clew::msg::State, 96 bytes: outcome is 256; allowed: at most 4");
}

TEST(Codec, ReadsUnvalidatedWhateverValuesThereAre) {
  std::string bytes = cdr_of_state_by_hand();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::memcpy(&bytes[4 + 24], &nan, sizeof nan);  // pose_world_robot.x_m
  bytes[4 + 64 + 7] ^= '\x80';                    // the sign of path_length_m
  bytes[4 + 72] = '\x09';                         // outcome
  Codec<domain::State> codec;
  domain::State state;

  ASSERT_TRUE(codec.decode_unvalidated(bytes, state).ok());
  EXPECT_TRUE(std::isnan(state.pose_world_robot.x_m));
  EXPECT_EQ(state.path_length_m, -12.25);
  EXPECT_EQ(static_cast<int>(state.outcome), 9);
  EXPECT_EQ(state.collisions, 3U);

  bytes[4 + 73] = '\x01';  // outcome 256 + 9, more than the domain's can hold
  ASSERT_TRUE(codec.decode_unvalidated(bytes, state).ok());
  EXPECT_EQ(static_cast<int>(state.outcome), 255);
}

TEST(Codec, RefusesUnvalidatedWhatHasNoPlaceInTheMessage) {
  Codec<domain::Guidance> codec;
  domain::Guidance guidance;
  const std::string none(codec.encode(guidance));
  guidance.virtual_obstacles.resize(16);
  std::string bytes(codec.encode(guidance));
  const auto length = std::mismatch(none.begin(), none.end(), bytes.begin()).second;
  *length = 17;
  bytes.insert(bytes.size() - 5, 32, '\0');  // an obstacle's four numbers, before `why`

  const core::Result<void> result = codec.decode_unvalidated(bytes, guidance);

  ASSERT_FALSE(result.ok());
  EXPECT_NE(result.error().text().find("virtual_obstacles is 17 values long; allowed: at most 16"),
            std::string::npos)
      << result.error().text();
  EXPECT_FALSE(codec.decode_unvalidated(none.substr(0, 50), guidance).ok());
}

TEST(Codec, RefusesABooleanThatIsNeither) {
  std::string bytes = cdr_of_state_by_hand();
  bytes[4 + 76] = '\x02';  // command_late
  Codec<domain::State> codec;
  domain::State state;

  const core::Result<void> result = codec.decode(bytes, state);

  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(),
            "clew::msg::State, 96 bytes: command_late is 2; allowed: 0 and 1");
}

TEST(CodecDeathTest, AbortsOnAMessageThatShouldNotHaveBeenMade) {
  Codec<domain::Target> codec;
  domain::Target target;
  target.radius_m = -1.0;

  EXPECT_DEATH(codec.encode(target), "radius_m is -1");
}

TEST(IdlFingerprint, IsThatOfTheHeaderForC) {
  EXPECT_EQ(idl_fingerprint().size(), 32u);
  EXPECT_EQ(std::string(CLEW_IDL_USER_DATA), "clew_idl=" + std::string(idl_fingerprint()) + ";");
}

}  // namespace
}  // namespace clew::bridge
