// SPDX-License-Identifier: Apache-2.0
#include "files/whole_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace clew::files {
namespace {

/// How many names beside a file are tried.
constexpr int kMostNames = 100;

core::Error cannot(const char* what, int number, const std::string& path) {
  return {std::string("cannot be ") + what + ": " + std::strerror(number), path};
}

/// 0, or the number of what went wrong.
int write_and_close(int file, const std::string& bytes) {
  const int failed = write_all(file, bytes) ? 0 : errno;
  // Some file systems tell only now that they have no room.
  const int closed = ::close(file) == 0 ? 0 : errno;
  return failed != 0 ? failed : closed;
}

/// A file beside `path` that can take its place, with its rights; -1 if nothing should: `path` is a
/// link, a device or a pipe, has other names or another owner, must not be written, or there is no
/// room for a file more in that directory. `beside` becomes its name: one that nothing had, so that
/// no link of others is followed.
int open_beside(const std::string& path, std::string& beside) {
  struct stat status {};
  const bool is_there = ::lstat(path.c_str(), &status) == 0;
  if (is_there && (!S_ISREG(status.st_mode) || status.st_nlink > 1 ||
                   status.st_uid != ::geteuid() || ::access(path.c_str(), W_OK) != 0)) {
    return -1;
  }
  const std::string stem = path + '~' + std::to_string(::getpid()) + '-';
  int file = -1;
  for (int i = 0; i < kMostNames && file < 0; ++i) {
    beside = stem + std::to_string(i);
    file = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file < 0 && errno != EEXIST) return -1;
  }
  if (file >= 0 && is_there) ::fchmod(file, status.st_mode & 07777);
  return file;
}

core::Result<void> write_in_place(const std::string& path, const std::string& bytes) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return cannot("written", errno, path);
  const int failed = write_and_close(file, bytes);
  if (failed != 0) return cannot("written", failed, path);
  return {};
}

}  // namespace

bool write_all(int file, const std::string& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t written = ::write(file, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    done += static_cast<std::size_t>(written);
  }
  return true;
}

core::Result<void> write_file(const std::string& path, const std::string& bytes) {
  std::string beside;
  const int file = open_beside(path, beside);
  if (file < 0) return write_in_place(path, bytes);
  int failed = write_and_close(file, bytes);
  if (failed == 0 && ::rename(beside.c_str(), path.c_str()) != 0) failed = errno;
  if (failed == 0) return {};
  ::unlink(beside.c_str());
  return cannot("written", failed, path);
}

core::Result<std::string> read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file) return cannot("read", errno, path);
  return bytes;
}

core::Result<void> make_directory(const std::string& path) {
  std::error_code code;
  std::filesystem::create_directories(path, code);
  if (code) return cannot("made", code.value(), path);
  return {};
}

}  // namespace clew::files
