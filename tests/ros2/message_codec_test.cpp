// SPDX-License-Identifier: Apache-2.0
#include "ros2/message_codec.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace clew::ros2 {
namespace {

template <typename Message>
std::string bytes_of(const Message& message) {
  std::vector<char> buffer;
  return std::string(encode(message, buffer));
}

TEST(MessageCodec, WritesCdrAsTheStandardSays) {
  Header header;
  header.stamp = {1, 2};
  header.frame_id = "ab";

  // Header; 1; 2; length 3 with the zero byte; the text.
  const std::string expected(
      "\x00\x01\x00\x00\x01\x00\x00\x00\x02\x00\x00\x00\x03\x00\x00\x00"
      "ab\x00",
      19);
  EXPECT_EQ(bytes_of(header), expected);
}

TEST(MessageCodec, ReadsWhatItWrites) {
  LaserScan scan;
  scan.header.frame_id = "laser";
  scan.angle_min = -1.5F;
  scan.ranges = {1.0F, std::numeric_limits<float>::infinity(), NAN};
  LaserScan read;

  ASSERT_TRUE(decode(bytes_of(scan), read).ok());

  EXPECT_EQ(bytes_of(read), bytes_of(scan));
  EXPECT_EQ(read.header.frame_id, "laser");
  EXPECT_EQ(read.ranges[1], std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(read.ranges[2]));
}

TEST(MessageCodec, RefusesEveryTruncation) {
  TFMessage message;
  message.transforms.resize(2);
  message.transforms[1].child_frame_id = "base_link";
  const std::string whole = bytes_of(message);
  TFMessage read;

  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(decode(whole.substr(0, size), read).ok()) << size;
  }
  EXPECT_TRUE(decode(whole, read).ok());
  EXPECT_FALSE(decode(whole + std::string(4, '\0'), read).ok());
}

TEST(MessageCodec, RefusesALengthThatCannotBe) {
  // A list of 2^32 - 1 transforms in twelve bytes.
  const std::string bytes("\x00\x01\x00\x00\xff\xff\xff\xff\x00\x00\x00\x00", 12);
  TFMessage read;

  const auto decoded = decode(bytes, read);

  ASSERT_FALSE(decoded.ok());
  EXPECT_NE(decoded.error().text().find("tf2_msgs/msg/TFMessage: transforms"), std::string::npos)
      << decoded.error().text();
}

TEST(MessageCodec, RefusesAnotherEncapsulation) {
  std::string bytes = bytes_of(Clock{});
  bytes[1] = 0;  // big-endian
  Clock read;

  const auto decoded = decode(bytes, read);

  ASSERT_FALSE(decoded.ok());
  EXPECT_EQ(decoded.error().text(), "rosgraph_msgs/msg/Clock: not in XCDR1, little-endian");
}

}  // namespace
}  // namespace clew::ros2
