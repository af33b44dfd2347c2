// SPDX-License-Identifier: Apache-2.0
#include "recording/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

namespace clew::bridge::mcap {
namespace {

enum class PathKind { kMissing, kRegularFile, kDirectory, kDevice };

PathKind kind_of(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return PathKind::kMissing;
  if (S_ISREG(status.st_mode)) return PathKind::kRegularFile;
  if (S_ISDIR(status.st_mode)) return PathKind::kDirectory;
  return PathKind::kDevice;
}

core::Error error_at(const std::string& path, const std::string& message) {
  return {message, path, 0, 0};
}

}  // namespace

core::Result<OutputFile> OutputFile::create(const std::string& path, bool overwrite) {
  const PathKind kind = kind_of(path);
  if (kind == PathKind::kDirectory) return error_at(path, "is a directory, a file is needed");
  if (kind == PathKind::kRegularFile && !overwrite) {
    return error_at(path, "exists; it is overwritten only with --force");
  }
  const std::string written_path = kind == PathKind::kDevice ? path : path + ".tmp~";
  int flags = O_WRONLY | O_CLOEXEC;
  if (kind != PathKind::kDevice) flags |= O_CREAT | (overwrite ? O_TRUNC : O_EXCL);
  const int descriptor = ::open(written_path.c_str(), flags, 0666);
  if (descriptor < 0 && errno == EEXIST) {
    return error_at(written_path,
                    "exists: a recording that is being written or was cut off; it is overwritten "
                    "only with --force");
  }
  if (descriptor < 0) {
    return error_at(written_path, std::string("cannot be written: ") + std::strerror(errno));
  }
  return OutputFile(path, written_path, descriptor);
}

OutputFile::OutputFile(std::string path, std::string written_path, int descriptor)
    : path_(std::move(path)), written_path_(std::move(written_path)), descriptor_(descriptor) {}

OutputFile::OutputFile(OutputFile&& other) noexcept { *this = std::move(other); }

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(written_path_, other.written_path_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(position_, other.position_);
  std::swap(state_, other.state_);
  return *this;
}

OutputFile::~OutputFile() { close(); }

void OutputFile::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

core::Result<void> OutputFile::fail(const std::string& what, int error_number) {
  state_ = error_at(written_path_, what + ": " + std::strerror(error_number) + "; the " +
                                       std::to_string(position_) +
                                       " bytes written before can still be read");
  close();
  return state_;
}

core::Result<void> OutputFile::append(std::string_view bytes) {
  CLEW_RETURN_IF_ERROR(state_);
  CLEW_CHECK(descriptor_ >= 0, "append to " + path_ + ", which is closed");
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return fail("cannot be written on", errno);
    position_ += static_cast<std::uint64_t>(written);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

core::Result<void> OutputFile::publish() {
  CLEW_RETURN_IF_ERROR(state_);
  CLEW_CHECK(descriptor_ >= 0, "publish of " + path_ + ", which is closed");
  const int closed = ::close(std::exchange(descriptor_, -1));
  if (closed != 0) return fail("cannot be closed", errno);
  if (written_path_ != path_ && std::rename(written_path_.c_str(), path_.c_str()) != 0) {
    return fail("cannot be renamed to " + path_, errno);
  }
  return {};
}

}  // namespace clew::bridge::mcap
