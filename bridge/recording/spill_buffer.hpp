// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "core/result.hpp"

namespace clew::bridge::mcap {

/// Bytes that are appended for hours and read once at the end: few stay in memory, more go into a
/// file without a name, so that the memory of whoever writes does not grow with what it writes.
class SpillBuffer {
 public:
  /// The file, once there is one, is in the directory of `neighbour`, or else in the system's for
  /// temporary files.
  explicit SpillBuffer(std::string neighbour) : neighbour_(std::move(neighbour)) {}
  SpillBuffer(SpillBuffer&& other) noexcept;
  SpillBuffer& operator=(SpillBuffer&& other) noexcept;
  ~SpillBuffer();

  core::Result<void> append(std::string_view bytes);
  std::uint64_t size() const { return file_bytes_ + memory_.size(); }
  /// Hands all bytes over, in order, in pieces; an error of `take` ends it.
  core::Result<void> read(const std::function<core::Result<void>(std::string_view)>& take) const;

  static constexpr std::size_t kMemoryBytes = std::size_t{256} * 1024;

 private:
  core::Result<void> spill();
  core::Error error(const std::string& what) const;

  std::string neighbour_;
  int descriptor_ = -1;
  std::uint64_t file_bytes_ = 0;
  std::string memory_;  ///< what comes after the file's content
};

}  // namespace clew::bridge::mcap
