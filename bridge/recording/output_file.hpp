// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/result.hpp"

namespace clew::bridge::mcap {

/// A file that gets its name only when it is whole: it grows as `<path>.tmp~` and is renamed by
/// publish(). A path that names a device or a pipe is written to directly. Destroyed before
/// publish(), or after an error, it leaves what was written under the temporary name.
class OutputFile {
 public:
  /// Refused: a path or a temporary name that exists, unless `overwrite`; a directory; a place that
  /// cannot be written to.
  static core::Result<OutputFile> create(const std::string& path, bool overwrite);

  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;
  ~OutputFile();

  /// Appends all of `bytes`. After an error every further call gives the same error and writes
  /// nothing.
  core::Result<void> append(std::string_view bytes);

  /// Closes the file and gives it its name. Survives the death of the process, not a power cut: the
  /// disk is not waited for.
  core::Result<void> publish();

  /// Bytes appended so far.
  std::uint64_t position() const { return position_; }

 private:
  OutputFile(std::string path, std::string written_path, int descriptor);
  core::Result<void> fail(const std::string& what, int error_number);
  void close();

  std::string path_;
  std::string written_path_;  ///< the temporary name, or path_ itself for a device
  int descriptor_ = -1;
  std::uint64_t position_ = 0;
  core::Result<void> state_;
};

}  // namespace clew::bridge::mcap
