// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "recording/byte_buffer.hpp"

namespace clew::bridge::mcap {

/// The text of an errno of open(2); of too many open files, with the limit and how it is asked for.
std::string why_not_opened(int error_number);

/// A file that is read, and its size when it was opened. Safe to share between threads.
///
/// A process keeps at most kMostOpen of them open, those that were read last: a recording may have
/// more files than a process may have descriptors. One that was closed is opened again when it is
/// read, and must be the same file then.
class InputFile {
 public:
  static constexpr std::size_t kMostOpen = 32;

  /// Refused: what cannot be opened, and what is no regular file.
  static core::Result<std::shared_ptr<const InputFile>> open(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& path() const { return path_; }
  std::uint64_t size() const { return size_; }

  /// Replaces `buffer` by bytes [offset, offset + bytes) of the file, which must lie within it.
  /// Refused: what the disk does not give, a file that has shrunk, and one that is another by now.
  core::Result<void> read(std::uint64_t offset, std::size_t bytes, ByteBuffer& buffer) const;

  /// An error that names this file.
  core::Error error(std::string message) const { return {std::move(message), path_, 0, 0}; }

 private:
  friend class OpenFiles;
  class Descriptor;

  explicit InputFile(std::string path) : path_(std::move(path)) {}
  core::Result<std::shared_ptr<const Descriptor>> open_again() const;

  std::string path_;
  std::uint64_t size_ = 0;
  dev_t device_ = 0;
  ino_t inode_ = 0;
  mutable std::shared_ptr<const Descriptor> descriptor_;  ///< none while it is closed: OpenFiles'
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
