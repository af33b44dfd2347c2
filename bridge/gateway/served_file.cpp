// SPDX-License-Identifier: Apache-2.0
#include "gateway/served_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <filesystem>

#include "core/check.hpp"
#include "gateway/web_limits.hpp"
#include "recording/input_file.hpp"
#include "recording/piece_files.hpp"

namespace clew::bridge {
namespace {

/// A file that is larger is asked for in ranges.
constexpr std::uint64_t kMostWholeBytes = 256u << 20;
constexpr char kType[] = "application/octet-stream";

std::optional<std::uint64_t> number_of(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

WebResponse refusal(unsigned status, const std::string& why) {
  return {status, "text/plain; charset=utf-8", why + '\n', {}};
}

std::string read_piece(int descriptor, std::uint64_t first, std::uint64_t size) {
  std::string bytes(size, '\0');
  std::size_t got = 0;
  while (got < bytes.size()) {
    const ssize_t more = ::pread(descriptor, bytes.data() + got, bytes.size() - got,
                                 static_cast<off_t>(first + got));
    if (more < 0 && errno == EINTR) continue;
    if (more <= 0) break;
    got += static_cast<std::size_t>(more);
  }
  bytes.resize(got);
  return bytes;
}

}  // namespace

std::optional<ByteRange> read_range(std::string_view header, std::uint64_t size) {
  constexpr std::string_view kUnit = "bytes=";
  if (header.substr(0, kUnit.size()) != kUnit || size == 0) return std::nullopt;
  header.remove_prefix(kUnit.size());
  const std::size_t dash = header.find('-');
  if (dash == std::string_view::npos) return std::nullopt;
  const std::string_view from = header.substr(0, dash);
  const std::string_view to = header.substr(dash + 1);
  const auto last = number_of(to);
  if (from.empty()) {  // so many at the end
    if (!last || *last == 0) return std::nullopt;
    return ByteRange{size - std::min(*last, size), size - 1};
  }
  const auto first = number_of(from);
  if (!first || *first >= size || (!to.empty() && !last)) return std::nullopt;
  const ByteRange range{*first, std::min(last.value_or(size - 1), size - 1)};
  if (range.last < range.first) return std::nullopt;
  return range;
}

/// A file while it answers.
class ServedFile::Opened {
 public:
  explicit Opened(const std::string& path) : descriptor_(open_there(path)) {
    struct statx state {};
    constexpr unsigned kWanted = STATX_BASIC_STATS | STATX_BTIME;
    if (descriptor_ < 0 || ::statx(descriptor_, "", AT_EMPTY_PATH, kWanted, &state) != 0) {
      error_number_ = errno;
      return;
    }
    is_regular_ = S_ISREG(state.stx_mode);
    size_ = state.stx_size;
    identity_.device = {state.stx_dev_major, state.stx_dev_minor};
    identity_.inode = state.stx_ino;
    if ((state.stx_mask & STATX_BTIME) == 0) return;
    identity_.born = {state.stx_btime.tv_sec, state.stx_btime.tv_nsec};
  }
  ~Opened() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  int descriptor() const { return descriptor_; }
  std::uint64_t size() const { return size_; }
  const Identity& identity() const { return identity_; }
  bool is_gone() const { return error_number_ == ENOENT || error_number_ == ENOTDIR; }
  /// Empty: nothing.
  std::string what_is_wrong() const {
    if (error_number_ != 0) return mcap::why_not_opened(error_number_);
    return is_regular_ ? std::string() : "is no regular file";
  }

 private:
  /// Of a file that its recorder has finished since, the name that it grew under is gone.
  static int open_there(const std::string& path) {
    // A pipe that nobody writes would keep open waiting for ever.
    constexpr int kFlags = O_RDONLY | O_CLOEXEC | O_NONBLOCK;
    const int number = ::open(path.c_str(), kFlags);
    if (number >= 0 || errno != ENOENT) return number;
    return ::open(piece_path(path, 0).c_str(), kFlags);
  }

  int descriptor_;
  int error_number_ = 0;
  bool is_regular_ = false;
  std::uint64_t size_ = 0;
  Identity identity_;
};

ServedFile::ServedFile(std::string path, const Identity& identity)
    : path_(std::move(path)),
      name_(std::filesystem::path(path_).filename().string()),
      identity_(identity) {}

core::Result<ServedFile> ServedFile::open(const std::string& path) {
  const Opened file(path);
  const std::string wrong = file.what_is_wrong();
  if (!wrong.empty()) return core::Error{wrong, path};
  return ServedFile(path, file.identity());
}

core::Result<ServedRecording> ServedRecording::open(const std::vector<std::string>& paths) {
  std::vector<ServedFile> files;
  for (const std::string& path : paths) {
    auto file = ServedFile::open(path);
    if (!file.ok()) return file.error();
    files.push_back(std::move(file).value());
  }
  CLEW_CHECK(!files.empty(), "a recording has a file");
  return ServedRecording(std::move(files));
}

WebResponse ServedFile::answer(const std::string& range) const {
  const Opened file(path_);
  const std::string wrong = file.what_is_wrong();
  if (file.is_gone()) return refusal(410, name_ + " was removed since it was opened here");
  if (!wrong.empty()) return refusal(500, name_ + " cannot be read again: " + wrong);
  if (!(file.identity() == identity_)) {
    return refusal(410, name_ + " is another file than when it was opened here");
  }
  return piece_of(file, range);
}

WebResponse ServedFile::piece_of(const Opened& file, const std::string& range) const {
  const std::uint64_t size = file.size();
  if (range.empty()) {
    if (size > kMostWholeBytes) return refusal(413, "ask for ranges of this file");
    return {200, kType, read_piece(file.descriptor(), 0, size), {{"Accept-Ranges", "bytes"}}};
  }
  const auto wanted = read_range(range, size);
  if (!wanted) {
    return {
        416, "text/plain", "no such range\n", {{"Content-Range", fmt::format("bytes */{}", size)}}};
  }
  const std::uint64_t most = wanted->last - wanted->first + 1;
  std::string bytes =
      read_piece(file.descriptor(), wanted->first, std::min<std::uint64_t>(most, kMostRangeBytes));
  if (bytes.empty()) return refusal(500, name_ + " has become shorter");
  const std::string told =
      fmt::format("bytes {}-{}/{}", wanted->first, wanted->first + bytes.size() - 1, size);
  return {206, kType, std::move(bytes), {{"Accept-Ranges", "bytes"}, {"Content-Range", told}}};
}

}  // namespace clew::bridge
