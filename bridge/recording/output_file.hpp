// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "core/result.hpp"

namespace clew::bridge::mcap {

/// Keeps other processes from writing a file, for as long as it is there.
class FileLock {
 public:
  FileLock() = default;
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FileLock& operator=(FileLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~FileLock();

  int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

/// A file that gets its name only when it is whole: it grows as `<path>.tmp~`, which publish()
/// renames. A path that names a device or a pipe is written to directly, and a
/// symbolic link stands for the file that it leads to. Destroyed before
/// publish(), or after an error, it leaves what was written under the temporary name.
class OutputFile {
 public:
  /// Makes the file, empty, under its temporary name. Refused: a path or a temporary name that
  /// exists, unless `overwrite`; a directory; a place that cannot be written to; a file that
  /// another process is writing.
  static core::Result<void> reserve(const std::string& path, bool overwrite);
  /// Opens what stands under the temporary name, at its beginning: the first append() replaces all
  /// of it, unless keep() says otherwise. Refused: a file that another process is writing.
  static core::Result<OutputFile> go_on(const std::string& path);
  /// reserve() and go_on().
  static core::Result<OutputFile> create(const std::string& path, bool overwrite);

  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;
  ~OutputFile();

  /// Appends all of `bytes`. After an error every further call gives the same error and writes
  /// nothing. An error too: the file was removed meanwhile.
  core::Result<void> append(std::string_view bytes);
  /// Puts `bytes` behind the end, where the next append() writes over them: until then a crash
  /// leaves them. Does nothing on a device.
  core::Result<void> write_ahead(std::string_view bytes);
  /// Until release(), append() only collects. What belongs together is then written by one call, so
  /// that a process which dies leaves all of it or nothing (the kernel may still cut such a write
  /// between two pages if it kills the process in the middle of it).
  void hold() { holds_ = true; }
  core::Result<void> release();
  /// While it keeps, append() writes nothing: it only demands that the bytes stand there already.
  void keep(bool keep) { keeps_ = keep; }

  /// Cuts off what stands behind the end and closes the file, which keeps its temporary name.
  core::Result<void> seal();
  /// seal(), and give_name(). Survives the death of the process, not a power cut: the disk is not
  /// waited for.
  core::Result<void> publish(bool overwrite = true);
  /// Gives a sealed file its name. Without `overwrite`, refused if a file of that name has
  /// appeared.
  static core::Result<void> give_name(const std::string& path, bool overwrite = true);

  /// The lock on this file, which outlives seal().
  core::Result<FileLock> share_lock() const;

  /// Removes a file. Refused: one that another process is writing.
  static core::Result<void> remove(const std::string& path);
  /// Takes back a reserve(): nothing stays under the temporary name. A device stays.
  static void discard(const std::string& path);

  /// Where a file grows until it is whole; the path itself for a device.
  static std::string temporary_name(const std::string& path);
  /// The file that a path leads to: a symbolic link is written through, as by any program, and
  /// stays.
  static std::string file_of(const std::string& path);

  /// The name that it gets when it is whole.
  const std::string& path() const { return path_; }
  /// Bytes appended so far.
  std::uint64_t position() const { return position_ + held_.size(); }

 private:
  OutputFile(std::string path, int descriptor, bool is_device, std::uint64_t file_bytes);
  core::Result<void> demand(std::string_view bytes);
  core::Result<void> write_at_end(std::string_view bytes);
  core::Result<void> check_still_there();
  bool has_its_tail() const;
  void keep_tail(std::string_view bytes);
  core::Result<void> fail(const std::string& what, int error_number);
  void close();

  std::string path_;
  std::string written_path_;  ///< the temporary name, or path_ itself for a device
  int descriptor_ = -1;
  bool is_device_ = false;
  bool keeps_ = false;
  bool holds_ = false;
  std::string held_;              ///< what release() will append
  std::uint64_t position_ = 0;    ///< behind what stands in the file
  std::uint64_t file_bytes_ = 0;  ///< the file's size
  std::string tail_;              ///< the last bytes before position_ that were appended
  std::string there_;             ///< kept for its memory
  core::Result<void> state_;
};

}  // namespace clew::bridge::mcap
