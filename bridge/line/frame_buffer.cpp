// SPDX-License-Identifier: Apache-2.0
#include "line/frame_buffer.hpp"

#include <cstring>
#include <utility>

namespace clew::bridge {

FrameBuffer::Header FrameBuffer::header_of(FrameType type, std::string_view payload) {
  Header header;
  const auto size = static_cast<std::uint32_t>(payload.size());
  header[0] = static_cast<char>(type);
  std::memcpy(header.data() + 1, &size, sizeof size);
  return header;
}

void FrameBuffer::append(const char* bytes, std::size_t size) {
  if (too_large_) return;
  received_.erase(0, std::exchange(consumed_, 0));
  received_.append(bytes, size);
}

std::optional<Frame> FrameBuffer::next() {
  if (too_large_ || received_.size() - consumed_ < kHeaderBytes) return std::nullopt;
  std::uint32_t size = 0;
  std::memcpy(&size, received_.data() + consumed_ + 1, sizeof size);
  if (size > most_payload_bytes_) {
    too_large_ = size;
    received_.clear();
    return std::nullopt;
  }
  if (received_.size() - consumed_ < kHeaderBytes + size) return std::nullopt;
  Frame frame{static_cast<FrameType>(received_[consumed_]),
              received_.substr(consumed_ + kHeaderBytes, size)};
  consumed_ += kHeaderBytes + size;
  return frame;
}

}  // namespace clew::bridge
