// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "line/frames.hpp"

namespace clew::bridge {

/// What has come on a line, taken apart into frames: a type, the payload's length, the payload.
class FrameBuffer {
 public:
  static constexpr std::size_t kHeaderBytes = 5;
  using Header = std::array<char, kHeaderBytes>;

  static Header header_of(FrameType type, std::string_view payload);

  explicit FrameBuffer(std::size_t most_payload_bytes) : most_payload_bytes_(most_payload_bytes) {}

  std::size_t most_payload() const { return most_payload_bytes_; }
  void allow_payload(std::size_t bytes) { most_payload_bytes_ = bytes; }

  void append(const char* bytes, std::size_t size);
  /// The next whole frame, if it is there.
  std::optional<Frame> next();
  /// The length that a frame gave for its payload, if that is more than is allowed. Nothing behind
  /// it makes sense, and next() gives nothing any more.
  std::optional<std::uint32_t> too_large() const { return too_large_; }

 private:
  std::size_t most_payload_bytes_;
  std::string received_;
  std::size_t consumed_ = 0;
  std::optional<std::uint32_t> too_large_;
};

}  // namespace clew::bridge
