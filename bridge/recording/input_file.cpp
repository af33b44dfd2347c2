// SPDX-License-Identifier: Apache-2.0
#include "recording/input_file.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace clew::bridge::mcap {
namespace {

constexpr std::size_t kWindowBytes = 1 << 18;

std::string why_not_opened(int error_number) {
  const std::string why = std::strerror(error_number);
  struct rlimit limit {};
  if (error_number != EMFILE || ::getrlimit(RLIMIT_NOFILE, &limit) != 0) return why;
  return why + "; this process may have " + std::to_string(limit.rlim_cur) +
         " (ulimit -n), and a recording that is split has all of its files open";
}

}  // namespace

core::Result<std::shared_ptr<const InputFile>> InputFile::open(const std::string& path) {
  // A pipe that nobody writes would keep open waiting for ever.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return core::Error{"cannot be read: " + why_not_opened(errno), path};
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(descriptor);
    return core::Error{
        "is no regular file: a recording is read from a file, not from a pipe, a device or a "
        "directory",
        path};
  }
  return std::shared_ptr<const InputFile>(
      new InputFile(path, descriptor, static_cast<std::uint64_t>(status.st_size)));
}

InputFile::InputFile(std::string path, int descriptor, std::uint64_t size)
    : path_(std::move(path)), descriptor_(descriptor), size_(size) {}

InputFile::~InputFile() { ::close(descriptor_); }

core::Result<void> InputFile::read(std::uint64_t offset, std::size_t bytes,
                                   ByteBuffer& buffer) const {
  CLEW_CHECK(offset <= size_ && bytes <= size_ - offset,
             std::to_string(bytes) + " bytes at " + std::to_string(offset) + " of " + path_ +
                 ", which has " + std::to_string(size_));
  char* out = buffer.resize(bytes);
  std::size_t left = bytes;
  while (left > 0) {
    const ssize_t got =
        ::pread(descriptor_, out, left, static_cast<off_t>(offset + (bytes - left)));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return error(std::string("cannot be read: ") + std::strerror(errno));
    if (got == 0) return error("has become shorter while it was read");
    out += got;
    left -= static_cast<std::size_t>(got);
  }
  return {};
}

core::Result<std::string_view> FileWindow::view(std::uint64_t offset, std::size_t bytes) {
  const bool inside = offset >= start_ && offset - start_ <= buffer_.size() &&
                      bytes <= buffer_.size() - (offset - start_);
  if (!inside) {
    const std::uint64_t wanted = std::max<std::uint64_t>(bytes, kWindowBytes);
    const std::uint64_t available = std::min(wanted, file_->size() - offset);
    const auto read = file_->read(offset, static_cast<std::size_t>(available), buffer_);
    if (!read.ok()) {
      buffer_.resize(0);
      return read.error();
    }
    start_ = offset;
  }
  return buffer_.view().substr(static_cast<std::size_t>(offset - start_), bytes);
}

}  // namespace clew::bridge::mcap
