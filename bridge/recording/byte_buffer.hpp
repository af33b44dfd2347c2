// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

namespace clew::bridge::mcap {

/// Bytes that are not set before something writes them: a length that a hostile file announces then
/// costs address space and no memory. Keeps its largest size.
class ByteBuffer {
 public:
  /// Room for `bytes`; what was in it is gone.
  char* resize(std::size_t bytes) {
    if (bytes > capacity_ || data_ == nullptr) {
      data_.reset(new char[bytes]);
      capacity_ = bytes;
    }
    size_ = bytes;
    return data_.get();
  }
  std::size_t size() const { return size_; }
  std::size_t capacity() const { return capacity_; }
  std::string_view view() const { return {data_.get(), size_}; }

 private:
  std::unique_ptr<char[]> data_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace clew::bridge::mcap
