// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "recording/byte_buffer.hpp"

namespace clew::bridge::mcap {

/// A file opened for reading, and its size at that time. Safe to share between threads.
class InputFile {
 public:
  /// Refused: what cannot be opened, and what is no regular file.
  static core::Result<std::shared_ptr<const InputFile>> open(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& path() const { return path_; }
  std::uint64_t size() const { return size_; }

  /// Replaces `buffer` by bytes [offset, offset + bytes) of the file, which must lie within it.
  /// Refused: what the disk does not give, and a file that has shrunk.
  core::Result<void> read(std::uint64_t offset, std::size_t bytes, ByteBuffer& buffer) const;

  /// An error that names this file.
  core::Error error(std::string message) const { return {std::move(message), path_, 0, 0}; }

 private:
  InputFile(std::string path, int descriptor, std::uint64_t size);

  std::string path_;
  int descriptor_;
  std::uint64_t size_;
};

/// Looks at a file in small steps from front to back, reading it in large ones.
class FileWindow {
 public:
  explicit FileWindow(std::shared_ptr<const InputFile> file) : file_(std::move(file)) {}

  /// Bytes [offset, offset + bytes), which must lie within the file; valid until the next call.
  core::Result<std::string_view> view(std::uint64_t offset, std::size_t bytes);

 private:
  std::shared_ptr<const InputFile> file_;
  ByteBuffer buffer_;
  std::uint64_t start_ = 0;
};

}  // namespace clew::bridge::mcap
