// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <istream>
#include <memory>
#include <optional>
#include <string>

#include "bench/compressed_lines.hpp"
#include "core/result.hpp"

namespace clew::bench {

/// Reads a file line by line; one line is held at a time. Where there is no such file, but one in
/// zstd's format (`path.zst`), it reads that.
class LineReader {
 public:
  static core::Result<LineReader> open(const std::string& path);

  /// The next line without its end, which stays valid until the next call; none at the end. What
  /// does not end in a newline is no line.
  const std::string* next();
  /// The number of that line, from 1, and where it begins.
  int number() const { return number_; }
  std::uint64_t offset() const { return offset_; }
  const std::string& path() const { return path_; }
  /// Whether the end is one of the file, and not of a disk that failed.
  core::Result<void> is_whole() const;

 private:
  explicit LineReader(std::string path);

  std::string path_;
  std::unique_ptr<CompressedInput> compressed_;  ///< null for a plain file
  std::unique_ptr<std::istream> stream_;
  std::string line_;
  int number_ = 0;
  std::uint64_t offset_ = 0;
  std::uint64_t next_offset_ = 0;
};

/// The place of a line among the others; none: it is left out.
using PlaceOfLine =
    std::function<core::Result<std::optional<std::size_t>>(const std::string& line, int number)>;

/// Puts the lines of a file in order, those after the first `header_lines`, in a new file that
/// takes the old one's place as a whole. Of several lines with one place the last counts. A file
/// in order is left as it is. Holds 16 bytes a line.
core::Result<void> sort_lines(const std::string& path, int header_lines, const PlaceOfLine& place);

/// A file that lines are appended to, one write a line: a process that is killed leaves at most one
/// torn line, the last, which is dropped when the file is opened again.
class LineFile {
 public:
  /// Opens or makes a file, and holds it against other processes. Waits so many seconds for one
  /// that has it.
  static core::Result<LineFile> open(const std::string& path, double patience_s = 0.0);

  LineFile(LineFile&& other) noexcept;
  LineFile& operator=(LineFile&&) = delete;
  ~LineFile();

  const std::string& path() const { return path_; }
  core::Result<void> append(const std::string& line);
  /// Drops all lines.
  core::Result<void> clear();

 private:
  LineFile(std::string path, int file) : path_(std::move(path)), file_(file) {}
  core::Result<void> cut_torn_line();
  core::Error failed(const std::string& what) const;

  std::string path_;
  int file_;
};

/// A file that is written beside the one it is to be, and takes its place when it is whole. Before
/// that it leaves nothing behind.
class NewFile {
 public:
  static core::Result<NewFile> open(const std::string& path);
  NewFile(NewFile&&) = default;
  NewFile& operator=(NewFile&&) = delete;
  ~NewFile();

  core::Result<void> write(const std::string& text);
  core::Result<void> finish();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  NewFile(std::string path, std::FILE* file) : path_(std::move(path)), file_(file) {}
  core::Error failed() const;

  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace clew::bench
