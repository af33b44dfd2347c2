// SPDX-License-Identifier: Apache-2.0
#include "recording/output_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <utility>

namespace clew::bridge::mcap {
namespace {

// Of what was written last, so many bytes are looked for again.
constexpr std::size_t kCheckedBytes = 64;

enum class PathKind { kMissing, kRegularFile, kDirectory, kDevice, kLinkToNothing, kOther };

PathKind kind_of(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    const bool is_there = ::lstat(path.c_str(), &status) == 0;
    return is_there ? PathKind::kLinkToNothing : PathKind::kMissing;
  }
  if (S_ISREG(status.st_mode)) return PathKind::kRegularFile;
  if (S_ISDIR(status.st_mode)) return PathKind::kDirectory;
  return S_ISCHR(status.st_mode) ? PathKind::kDevice : PathKind::kOther;
}

core::Error error_at(const std::string& path, const std::string& message) {
  return {message, path, 0, 0};
}

core::Error cannot_be_written(const std::string& path) {
  return error_at(path, std::string("cannot be written: ") + std::strerror(errno));
}

// Held until the file is closed, however its process ends.
bool lock(int descriptor) { return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0; }

core::Error in_use(const std::string& path) {
  return error_at(path, "is being written by another process");
}

}  // namespace

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::string OutputFile::file_of(const std::string& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0 || !S_ISLNK(status.st_mode)) return path;
  const std::unique_ptr<char, decltype(&std::free)> real(::realpath(path.c_str(), nullptr),
                                                         &std::free);
  return real ? real.get() : path;
}

std::string OutputFile::temporary_name(const std::string& path) {
  return kind_of(path) == PathKind::kDevice ? path : file_of(path) + ".tmp~";
}

core::Result<void> OutputFile::reserve(const std::string& path, bool overwrite) {
  const PathKind kind = kind_of(path);
  if (kind == PathKind::kDirectory) return error_at(path, "is a directory, a file is needed");
  if (kind == PathKind::kRegularFile && !overwrite) {
    return error_at(path, "exists; it is overwritten only with --force");
  }
  if (kind == PathKind::kLinkToNothing) {
    return error_at(path,
                    "is a symbolic link to what is not there; a recording is written to a file");
  }
  if (kind == PathKind::kOther) {
    return error_at(path, "is a pipe, a socket or a disk; a recording is written to a file");
  }
  if (kind == PathKind::kDevice) return {};
  const std::string written_path = temporary_name(path);
  const int flags = O_WRONLY | O_CLOEXEC | O_NONBLOCK | O_CREAT | (overwrite ? 0 : O_EXCL);
  const int descriptor = ::open(written_path.c_str(), flags, 0666);
  if (descriptor < 0 && errno == EEXIST) {
    return error_at(written_path,
                    "exists: a recording that is being written or was cut off; it is overwritten "
                    "only with --force");
  }
  if (descriptor < 0) return cannot_be_written(written_path);
  const bool ours = lock(descriptor);
  const bool emptied = ours && ::ftruncate(descriptor, 0) == 0;
  ::close(descriptor);
  if (!ours) return in_use(written_path);
  if (!emptied) return cannot_be_written(written_path);
  return {};
}

void OutputFile::discard(const std::string& path) {
  const std::string written_path = temporary_name(path);
  if (written_path != path) std::remove(written_path.c_str());
}

core::Result<void> OutputFile::remove(const std::string& path) {
  const FileLock file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  const bool opened = file.descriptor() >= 0;
  if (opened && !lock(file.descriptor())) return in_use(path);
  if (opened && ::unlink(path.c_str()) == 0) return {};
  return error_at(path, std::string("cannot be removed: ") + std::strerror(errno));
}

core::Result<FileLock> OutputFile::share_lock() const {
  const int shared = ::fcntl(descriptor_, F_DUPFD_CLOEXEC, 0);
  if (shared < 0) return cannot_be_written(written_path_);
  return FileLock(shared);
}

core::Result<OutputFile> OutputFile::go_on(const std::string& path) {
  const bool is_device = kind_of(path) == PathKind::kDevice;
  const std::string written_path = temporary_name(path);
  const int flags = is_device ? O_WRONLY : O_RDWR;
  const int descriptor = ::open(written_path.c_str(), flags | O_CLOEXEC);
  struct stat status {};
  if (descriptor < 0 || ::fstat(descriptor, &status) != 0) return cannot_be_written(written_path);
  if (!is_device && !lock(descriptor)) {
    ::close(descriptor);
    return in_use(written_path);
  }
  const auto file_bytes = is_device ? 0 : static_cast<std::uint64_t>(status.st_size);
  return OutputFile(path, descriptor, is_device, file_bytes);
}

core::Result<OutputFile> OutputFile::create(const std::string& path, bool overwrite) {
  CLEW_RETURN_IF_ERROR(reserve(path, overwrite));
  return go_on(path);
}

OutputFile::OutputFile(std::string path, int descriptor, bool is_device, std::uint64_t file_bytes)
    : path_(std::move(path)),
      written_path_(is_device ? path_ : temporary_name(path_)),
      descriptor_(descriptor),
      is_device_(is_device),
      file_bytes_(file_bytes) {}

OutputFile::OutputFile(OutputFile&& other) noexcept { *this = std::move(other); }

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(written_path_, other.written_path_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(is_device_, other.is_device_);
  std::swap(keeps_, other.keeps_);
  std::swap(holds_, other.holds_);
  std::swap(held_, other.held_);
  std::swap(position_, other.position_);
  std::swap(file_bytes_, other.file_bytes_);
  std::swap(tail_, other.tail_);
  std::swap(state_, other.state_);
  return *this;
}

OutputFile::~OutputFile() { close(); }

void OutputFile::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

// Of what could not be written as a whole nothing stays.
core::Result<void> OutputFile::fail(const std::string& what, int error_number) {
  state_ = error_at(written_path_, what + ": " + std::strerror(error_number) + "; the " +
                                       std::to_string(position_) +
                                       " bytes written before can still be read");
  if (!is_device_ && !keeps_ && descriptor_ >= 0 &&
      ::ftruncate(descriptor_, static_cast<off_t>(position_)) != 0) {
    state_ = error_at(written_path_, what + ": " + std::strerror(error_number) +
                                         "; what was written can be read up to the last record");
  }
  close();
  return state_;
}

core::Result<void> OutputFile::append(std::string_view bytes) {
  CLEW_RETURN_IF_ERROR(state_);
  CLEW_CHECK(descriptor_ >= 0, "append to " + path_ + ", which is closed");
  if (holds_) {
    held_ += bytes;
    return {};
  }
  if (keeps_) return demand(bytes);
  CLEW_RETURN_IF_ERROR(write_at_end(bytes));
  position_ += bytes.size();
  keep_tail(bytes);
  if (file_bytes_ > position_) {
    if (::ftruncate(descriptor_, static_cast<off_t>(position_)) != 0) {
      return fail("cannot be cut", errno);
    }
    file_bytes_ = position_;
  }
  return {};
}

core::Result<void> OutputFile::release() {
  holds_ = false;
  const std::string together = std::exchange(held_, {});
  return append(together);
}

void OutputFile::keep_tail(std::string_view bytes) {
  tail_ += bytes.substr(bytes.size() - std::min(bytes.size(), kCheckedBytes));
  tail_.erase(0, tail_.size() - std::min(tail_.size(), kCheckedBytes));
}

core::Result<void> OutputFile::write_ahead(std::string_view bytes) {
  CLEW_RETURN_IF_ERROR(state_);
  if (is_device_ || keeps_) return {};
  return write_at_end(bytes);
}

core::Result<void> OutputFile::demand(std::string_view bytes) {
  there_.resize(bytes.size());
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got = ::pread(descriptor_, there_.data() + done, bytes.size() - done,
                                static_cast<off_t>(position_ + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return fail("cannot be read", errno);
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  if (done < bytes.size() || there_ != bytes) {
    return state_ = error_at(written_path_, "holds at byte " + std::to_string(position_) +
                                                " what this version does not write for this run");
  }
  position_ += bytes.size();
  keep_tail(bytes);
  return {};
}

core::Result<void> OutputFile::write_at_end(std::string_view bytes) {
  CLEW_RETURN_IF_ERROR(check_still_there());
  std::uint64_t at = position_;
  while (!bytes.empty()) {
    const ssize_t written =
        is_device_ ? ::write(descriptor_, bytes.data(), bytes.size())
                   : ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return fail("cannot be written on", errno);
    at += static_cast<std::uint64_t>(written);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  if (at > file_bytes_) file_bytes_ = at;
  return check_still_there();
}

/// Whether what was written last is still there. A file that is cut and written on has its length
/// again, with zeros in between.
bool OutputFile::has_its_tail() const {
  std::array<char, kCheckedBytes> found;
  const ssize_t got = ::pread(descriptor_, found.data(), tail_.size(),
                              static_cast<off_t>(position_ - tail_.size()));
  return got >= 0 && std::string_view(found.data(), static_cast<std::size_t>(got)) == tail_;
}

// Writing to a file without a name succeeds, and is lost.
core::Result<void> OutputFile::check_still_there() {
  struct stat status {};
  if (is_device_) return {};
  const bool known = ::fstat(descriptor_, &status) == 0;
  const bool long_enough = known && static_cast<std::uint64_t>(status.st_size) >= position_;
  const bool whole = long_enough && has_its_tail();
  if (whole && status.st_nlink > 0) return {};
  state_ = error_at(written_path_, known && status.st_nlink > 0
                                       ? "was cut by somebody else while it was written"
                                       : "was removed while it was written");
  close();
  return state_;
}

core::Result<void> OutputFile::seal() {
  CLEW_RETURN_IF_ERROR(state_);
  CLEW_CHECK(descriptor_ >= 0, "seal of " + path_ + ", which is closed");
  CLEW_RETURN_IF_ERROR(check_still_there());
  if (!is_device_ && ::ftruncate(descriptor_, static_cast<off_t>(position_)) != 0) {
    return fail("cannot be cut", errno);
  }
  if (::close(std::exchange(descriptor_, -1)) != 0) return fail("cannot be closed", errno);
  return {};
}

core::Result<void> OutputFile::publish(bool overwrite) {
  CLEW_RETURN_IF_ERROR(seal());
  return state_ = give_name(path_, overwrite);
}

core::Result<void> OutputFile::give_name(const std::string& path, bool overwrite) {
  const std::string written_path = temporary_name(path);
  if (written_path == path) return {};
  const std::string named = file_of(path);
  const unsigned flags = overwrite ? 0U : RENAME_NOREPLACE;
  if (::renameat2(AT_FDCWD, written_path.c_str(), AT_FDCWD, named.c_str(), flags) == 0) return {};
  // Not every file system can tell and rename at once.
  if (errno == EINVAL && kind_of(path) == PathKind::kMissing &&
      std::rename(written_path.c_str(), named.c_str()) == 0) {
    return {};
  }
  if (errno == EEXIST || errno == EINVAL) {
    return error_at(
        path, "has appeared while the run went on, and is not overwritten; the recording is " +
                  written_path);
  }
  return error_at(written_path, "cannot be renamed to " + path + ": " + std::strerror(errno));
}

}  // namespace clew::bridge::mcap
