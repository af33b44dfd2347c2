// SPDX-License-Identifier: Apache-2.0
#include "bench/line_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <thread>
#include <utility>
#include <vector>

#include "files/whole_file.hpp"

namespace clew::bench {

using core::Error;
using core::Result;

namespace {

constexpr char kUnfinished[] = ".new";  // of a file that is being written

bool hold(int file, double patience_s) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience_s);
  while (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    if (std::chrono::steady_clock::now() >= until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

struct PlacedLine {
  std::size_t place;
  std::uint64_t offset;
};

Result<void> copy_line(LineReader& from, NewFile& to) {
  const std::string* line = from.next();
  if (line == nullptr) return from.is_whole();
  return to.write(*line + '\n');
}

/// The lines of a file at their offsets, in the order given.
Result<void> copy_lines(const std::string& path, const std::vector<PlacedLine>& lines,
                        NewFile& to) {
  std::ifstream file(path);
  for (const PlacedLine& line : lines) {
    std::string text;
    if (!file.seekg(static_cast<std::streamoff>(line.offset)) || !std::getline(file, text)) {
      return Error{std::string("cannot be read: ") + std::strerror(errno), path};
    }
    CLEW_RETURN_IF_ERROR(to.write(text + '\n'));
  }
  return {};
}

}  // namespace

LineReader::LineReader(std::string path) : path_(std::move(path)) {
  if (::access(path_.c_str(), F_OK) != 0) {
    compressed_ = std::make_unique<CompressedInput>(path_ + kCompressedEnding);
    if (!compressed_->is_open()) compressed_.reset();
  }
  if (compressed_) {
    stream_ = std::make_unique<std::istream>(compressed_.get());
  } else {
    stream_ = std::make_unique<std::ifstream>(path_);
  }
}

Result<LineReader> LineReader::open(const std::string& path) {
  LineReader reader(path);
  if (*reader.stream_) return reader;
  return Error{std::string("cannot be read: ") + std::strerror(errno), path};
}

const std::string* LineReader::next() {
  offset_ = next_offset_;
  if (!std::getline(*stream_, line_) || stream_->eof()) return nullptr;
  next_offset_ += line_.size() + 1;
  ++number_;
  return &line_;
}

Result<void> LineReader::is_whole() const {
  if (compressed_ && !compressed_->damage().empty()) {
    return Error{"is damaged: " + compressed_->damage(), path_ + kCompressedEnding};
  }
  if (!stream_->bad()) return {};
  return Error{std::string("cannot be read: ") + std::strerror(errno), path_};
}

Result<void> sort_lines(const std::string& path, int header_lines, const PlaceOfLine& place) {
  auto reader = LineReader::open(path);
  if (!reader.ok()) return reader.error();
  std::vector<PlacedLine> lines;
  bool is_sorted = true;
  while (const std::string* line = reader->next()) {
    if (reader->number() <= header_lines) continue;
    const auto placed = place(*line, reader->number());
    if (!placed.ok()) return placed.error();
    is_sorted = is_sorted && *placed && (lines.empty() || lines.back().place < **placed);
    if (*placed) lines.push_back({**placed, reader->offset()});
  }
  CLEW_RETURN_IF_ERROR(reader->is_whole());
  if (is_sorted) return {};
  // Of lines with one place the last is to come first, which std::unique keeps.
  std::sort(lines.begin(), lines.end(), [](const PlacedLine& a, const PlacedLine& b) {
    return a.place != b.place ? a.place < b.place : a.offset > b.offset;
  });
  lines.erase(std::unique(lines.begin(), lines.end(),
                          [](const auto& a, const auto& b) { return a.place == b.place; }),
              lines.end());
  auto sorted = NewFile::open(path);
  if (!sorted.ok()) return sorted.error();
  auto header = LineReader::open(path);
  if (!header.ok()) return header.error();
  for (int i = 0; i < header_lines; ++i) CLEW_RETURN_IF_ERROR(copy_line(*header, *sorted));
  CLEW_RETURN_IF_ERROR(copy_lines(path, lines, *sorted));
  return sorted->finish();
}

Result<LineFile> LineFile::open(const std::string& path, double patience_s) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    return Error{std::string("cannot be written: ") + std::strerror(errno), path};
  }
  LineFile file(path, descriptor);
  if (!hold(descriptor, patience_s)) {
    return Error{"is being written by another bench", path};
  }
  CLEW_RETURN_IF_ERROR(file.cut_torn_line());
  return file;
}

LineFile::LineFile(LineFile&& other) noexcept
    : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}

LineFile::~LineFile() {
  if (file_ >= 0) ::close(file_);
}

Result<void> LineFile::append(const std::string& line) {
  if (files::write_all(file_, line + '\n')) return {};
  return failed("cannot be written");
}

Result<void> LineFile::clear() {
  if (::ftruncate(file_, 0) != 0) return failed("cannot be emptied");
  return {};
}

/// What does not end in a newline was torn off by the end of its process.
Result<void> LineFile::cut_torn_line() {
  const off_t size = ::lseek(file_, 0, SEEK_END);
  if (size < 0) return failed("cannot be read");
  off_t whole = size;
  char last = '\n';
  for (; whole > 0; --whole) {
    if (::pread(file_, &last, 1, whole - 1) != 1) return failed("cannot be read");
    if (last == '\n') break;
  }
  if (whole != size && ::ftruncate(file_, whole) != 0) return failed("cannot be cut");
  return {};
}

Error LineFile::failed(const std::string& what) const {
  return {what + ": " + std::strerror(errno), path_};
}

Result<NewFile> NewFile::open(const std::string& path) {
  NewFile file(path, std::fopen((path + kUnfinished).c_str(), "we"));
  if (!file.file_) return file.failed();
  return file;
}

NewFile::~NewFile() {
  if (file_) std::remove((path_ + kUnfinished).c_str());
}

Result<void> NewFile::write(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size()) return {};
  return failed();
}

Result<void> NewFile::finish() {
  // Some file systems tell only now that they have no room.
  if (std::fclose(file_.release()) != 0) return failed();
  if (std::rename((path_ + kUnfinished).c_str(), path_.c_str()) != 0) return failed();
  return {};
}

Error NewFile::failed() const {
  return {std::string("cannot be written: ") + std::strerror(errno), path_};
}

}  // namespace clew::bench
