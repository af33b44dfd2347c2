// SPDX-License-Identifier: Apache-2.0
#include "recording/spill_buffer.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

namespace clew::bridge::mcap {
namespace {

// Not every file system has files without a name: then none, and the bytes stay in memory.
int open_nameless(const std::string& neighbour) {
  std::error_code ignored;
  const std::filesystem::path beside = std::filesystem::path(neighbour).parent_path();
  for (const std::filesystem::path& directory :
       {beside.empty() ? std::filesystem::path(".") : beside,
        std::filesystem::temp_directory_path(ignored)}) {
    const int descriptor = ::open(directory.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (descriptor >= 0) return descriptor;
  }
  return -1;
}

}  // namespace

SpillBuffer::SpillBuffer(SpillBuffer&& other) noexcept { *this = std::move(other); }

SpillBuffer& SpillBuffer::operator=(SpillBuffer&& other) noexcept {
  std::swap(neighbour_, other.neighbour_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(file_bytes_, other.file_bytes_);
  std::swap(memory_, other.memory_);
  return *this;
}

SpillBuffer::~SpillBuffer() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

core::Error SpillBuffer::error(const std::string& what) const {
  return {"its index " + what + ": " + std::strerror(errno), neighbour_};
}

core::Result<void> SpillBuffer::append(std::string_view bytes) {
  memory_.append(bytes);
  return memory_.size() < kMemoryBytes ? core::Result<void>() : spill();
}

core::Result<void> SpillBuffer::spill() {
  if (descriptor_ < 0) descriptor_ = open_nameless(neighbour_);
  if (descriptor_ < 0) return {};
  std::size_t done = 0;
  while (done < memory_.size()) {
    const ssize_t written = ::pwrite(descriptor_, memory_.data() + done, memory_.size() - done,
                                     static_cast<off_t>(file_bytes_ + done));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return error("cannot be put aside");
    done += static_cast<std::size_t>(written);
  }
  file_bytes_ += memory_.size();
  memory_.clear();
  return {};
}

core::Result<void> SpillBuffer::read(
    const std::function<core::Result<void>(std::string_view)>& take) const {
  std::string piece(std::min<std::uint64_t>(kMemoryBytes, file_bytes_), '\0');
  std::uint64_t done = 0;
  while (done < file_bytes_) {
    const auto want =
        static_cast<std::size_t>(std::min<std::uint64_t>(piece.size(), file_bytes_ - done));
    const ssize_t got = ::pread(descriptor_, piece.data(), want, static_cast<off_t>(done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return error("cannot be read back");
    CLEW_RETURN_IF_ERROR(take(std::string_view(piece).substr(0, static_cast<std::size_t>(got))));
    done += static_cast<std::uint64_t>(got);
  }
  return take(memory_);
}

}  // namespace clew::bridge::mcap
