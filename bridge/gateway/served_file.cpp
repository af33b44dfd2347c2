// SPDX-License-Identifier: Apache-2.0
#include "gateway/served_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>

#include "core/check.hpp"
#include "gateway/web_limits.hpp"

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

core::Result<ServedFile> ServedFile::open(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return core::Error{std::strerror(errno), path};
  return ServedFile(descriptor, std::filesystem::path(path).filename().string());
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

ServedFile::~ServedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

WebResponse ServedFile::answer(const std::string& range) const {
  struct stat state {};
  if (::fstat(descriptor_, &state) != 0)
    return {500, "text/plain", "the file cannot be read\n", {}};
  const auto size = static_cast<std::uint64_t>(state.st_size);
  if (range.empty()) {
    if (size > kMostWholeBytes) return {413, "text/plain", "ask for ranges of this file\n", {}};
    return {200, kType, read_piece(descriptor_, 0, size), {{"Accept-Ranges", "bytes"}}};
  }
  const auto wanted = read_range(range, size);
  if (!wanted) {
    return {
        416, "text/plain", "no such range\n", {{"Content-Range", fmt::format("bytes */{}", size)}}};
  }
  const std::uint64_t most = wanted->last - wanted->first + 1;
  std::string bytes =
      read_piece(descriptor_, wanted->first, std::min<std::uint64_t>(most, kMostRangeBytes));
  if (bytes.empty()) return {500, "text/plain", "the file has become shorter\n", {}};
  const std::string told =
      fmt::format("bytes {}-{}/{}", wanted->first, wanted->first + bytes.size() - 1, size);
  return {206, kType, std::move(bytes), {{"Accept-Ranges", "bytes"}, {"Content-Range", told}}};
}

}  // namespace clew::bridge
