// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "gateway/web_server.hpp"

namespace clew::bridge {

/// The bytes from `first` to `last`, both included.
struct ByteRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
};

/// One range of a header `Range: bytes=0-99` (also `100-`, `-100`) of a file of `size` bytes; none
/// if there is no such range.
std::optional<ByteRange> read_range(std::string_view header, std::uint64_t size);

/// A file that was named on the command line. It is opened for each answer and closed after it: a
/// recording may have more files than a process may have open. One that was removed or replaced
/// since is not served.
class ServedFile {
 public:
  /// Refused: what cannot be opened, and what is no regular file.
  static core::Result<ServedFile> open(const std::string& path);

  /// Its name without the folder, for people.
  const std::string& name() const { return name_; }
  /// All of it, or the range that is asked for, of which it may give less: a piece at a time.
  WebResponse answer(const std::string& range) const;

 private:
  /// A number of an inode may be given again: the time of birth, where the disk keeps it, tells.
  struct Identity {
    std::pair<std::uint32_t, std::uint32_t> device;
    std::uint64_t inode = 0;
    std::pair<std::int64_t, std::uint32_t> born;

    bool operator==(const Identity& other) const {
      return device == other.device && inode == other.inode && born == other.born;
    }
  };
  class Opened;

  ServedFile(std::string path, const Identity& identity);
  WebResponse piece_of(const Opened& file, const std::string& range) const;

  std::string path_;
  std::string name_;
  Identity identity_;
};

/// The files of a recording, in their order; more than one if it is split.
class ServedRecording {
 public:
  /// At least one path.
  static core::Result<ServedRecording> open(const std::vector<std::string>& paths);

  const std::string& name() const { return files_.front().name(); }
  const std::vector<ServedFile>& files() const { return files_; }

 private:
  explicit ServedRecording(std::vector<ServedFile> files) : files_(std::move(files)) {}

  std::vector<ServedFile> files_;
};

}  // namespace clew::bridge
