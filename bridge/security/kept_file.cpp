// SPDX-License-Identifier: Apache-2.0
#include "security/kept_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;

constexpr mode_t kPermissionBits = 07777;
constexpr mode_t kOthersWrite = S_IWGRP | S_IWOTH;
constexpr mode_t kOthersAnything = S_IRWXG | S_IRWXO;
/// A certificate has about 1 KiB, permissions for every topic about 3 KiB.
constexpr off_t kMostBytes = 64 * 1024;

class Descriptor {
 public:
  Descriptor(const std::string& path, int flags, mode_t mode = 0)
      : number_(::open(path.c_str(), flags | O_CLOEXEC, mode)) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

/// What is wrong with whom it belongs to and who may do what with it.
void check_owner_and_mode(const std::string& path, const struct stat& status, mode_t forbidden,
                          std::vector<CredentialFault>& faults) {
  if (status.st_uid != ::geteuid() && status.st_uid != 0) {
    faults.push_back({path, fmt::format("belongs to user {}; allowed: user {} and root",
                                        status.st_uid, ::geteuid())});
  }
  const mode_t mode = status.st_mode & kPermissionBits;
  if ((mode & forbidden) == 0) return;
  const bool readable = (mode & forbidden & (S_IRGRP | S_IROTH)) != 0;
  faults.push_back({path, fmt::format("may be {} by others: its mode is {:04o}; allowed: {:04o}",
                                      readable ? "read" : "changed", mode, mode & ~forbidden)});
}

/// Root reads everything, and would not notice.
bool owner_may_read(const struct stat& status) { return (status.st_mode & S_IRUSR) != 0; }

std::string read_all(int file, off_t size) {
  std::string text(static_cast<std::size_t>(size), '\0');
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t got = ::read(file, text.data() + done, text.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    done += static_cast<std::size_t>(got);
  }
  text.resize(done);
  return text;
}

}  // namespace

std::string read_kept_file(const std::string& path, Secrecy secrecy,
                           std::vector<CredentialFault>& faults) {
  const Descriptor file(path, O_RDONLY | O_NONBLOCK);
  struct stat status {};
  if (file.number() < 0 || ::fstat(file.number(), &status) != 0) {
    faults.push_back({path, std::string("cannot be read: ") + std::strerror(errno)});
    return {};
  }
  if (!S_ISREG(status.st_mode)) {
    faults.push_back({path, "is no regular file"});
    return {};
  }
  if (!owner_may_read(status)) {
    faults.push_back({path, "cannot be read: its owner may not"});
    return {};
  }
  check_owner_and_mode(path, status, secrecy == Secrecy::kSecret ? kOthersAnything : kOthersWrite,
                       faults);
  if (status.st_size == 0 || status.st_size > kMostBytes) {
    faults.push_back(
        {path, fmt::format("has {} bytes; allowed: 1 to {}", status.st_size, kMostBytes)});
    return {};
  }
  return read_all(file.number(), status.st_size);
}

void check_kept_directory(const std::string& path, std::vector<CredentialFault>& faults) {
  const Descriptor directory(path, O_RDONLY | O_DIRECTORY);
  struct stat status {};
  if (directory.number() < 0 || ::fstat(directory.number(), &status) != 0) {
    faults.push_back({path, std::string("is no directory of keys: ") + std::strerror(errno)});
    return;
  }
  check_owner_and_mode(path, status, kOthersWrite, faults);
}

Result<void> write_kept_file(const std::string& path, const std::string& text, Secrecy secrecy) {
  const std::string unfinished = path + ".new";
  const auto cannot = [&] {
    Error error{std::string("cannot be written: ") + std::strerror(errno), path};
    ::unlink(unfinished.c_str());
    return error;
  };
  ::unlink(unfinished.c_str());
  Descriptor file(
      unfinished, O_WRONLY | O_CREAT | O_EXCL,
      secrecy == Secrecy::kSecret ? S_IRUSR | S_IWUSR : S_IRUSR | S_IWUSR | S_IRGRP | S_IROTH);
  if (file.number() < 0 ||
      ::write(file.number(), text.data(), text.size()) != static_cast<ssize_t>(text.size()) ||
      ::fsync(file.number()) != 0 || !file.close() ||
      ::rename(unfinished.c_str(), path.c_str()) != 0) {
    return cannot();
  }
  return {};
}

}  // namespace clew::bridge
