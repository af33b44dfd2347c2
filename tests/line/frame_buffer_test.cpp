// SPDX-License-Identifier: Apache-2.0
#include "line/frame_buffer.hpp"

#include <gtest/gtest.h>

namespace clew::bridge {
namespace {

std::string frame_bytes(FrameType type, const std::string& payload) {
  const auto header = FrameBuffer::header_of(type, payload);
  return std::string(header.data(), header.size()) + payload;
}

TEST(FrameBuffer, WritesATypeAndALittleEndianLength) {
  const auto header = FrameBuffer::header_of(FrameType::kAlive, std::string(258, 'x'));
  EXPECT_EQ(std::string(header.data(), header.size()),
            std::string(1, static_cast<char>(FrameType::kAlive)) + std::string("\x02\x01\0\0", 4));
}

TEST(FrameBuffer, GivesFramesHoweverTheBytesCome) {
  const std::string all = frame_bytes(FrameType::kNotice, "one") +
                          frame_bytes(FrameType::kAlive, "") +
                          frame_bytes(FrameType::kFatal, "three");
  for (std::size_t step = 1; step <= all.size(); ++step) {
    FrameBuffer buffer(5);
    std::string text;
    for (std::size_t at = 0; at < all.size(); at += step) {
      const std::string part = all.substr(at, step);
      buffer.append(part.data(), part.size());
      while (const auto frame = buffer.next()) {
        text += std::to_string(static_cast<int>(frame->type)) + frame->payload + ' ';
      }
    }
    EXPECT_EQ(text, std::to_string(static_cast<int>(FrameType::kNotice)) + "one " +
                        std::to_string(static_cast<int>(FrameType::kAlive)) + ' ' +
                        std::to_string(static_cast<int>(FrameType::kFatal)) + "three ")
        << step;
    EXPECT_EQ(buffer.too_large(), std::nullopt);
  }
}

TEST(FrameBuffer, GivesNothingBehindAFrameThatIsTooLarge) {
  FrameBuffer buffer(3);
  const std::string bytes = frame_bytes(FrameType::kNotice, "one") +
                            frame_bytes(FrameType::kNotice, "four") +
                            frame_bytes(FrameType::kNotice, "one");
  buffer.append(bytes.data(), bytes.size());

  EXPECT_EQ(buffer.next()->payload, "one");
  EXPECT_FALSE(buffer.next().has_value());
  EXPECT_EQ(buffer.too_large(), 4u);

  const std::string more = frame_bytes(FrameType::kNotice, "one");
  buffer.append(more.data(), more.size());
  EXPECT_FALSE(buffer.next().has_value());
}

TEST(FrameBuffer, MayTakeMoreLater) {
  FrameBuffer buffer(3);
  buffer.allow_payload(4);
  const std::string bytes = frame_bytes(FrameType::kNotice, "four");
  buffer.append(bytes.data(), bytes.size());
  EXPECT_EQ(buffer.next()->payload, "four");
}

}  // namespace
}  // namespace clew::bridge
