// SPDX-License-Identifier: Apache-2.0
#include "files/whole_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace clew::files {
namespace {

core::Error cannot(const char* what, int number, const std::string& path) {
  return {std::string("cannot be ") + what + ": " + std::strerror(number), path};
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
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return cannot("written", errno, path);
  const int failed = write_all(file, bytes) ? 0 : errno;
  // Some file systems tell only now that they have no room.
  const int closed = ::close(file) == 0 ? 0 : errno;
  if (failed != 0) return cannot("written", failed, path);
  if (closed != 0) return cannot("written", closed, path);
  return {};
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
