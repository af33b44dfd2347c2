// SPDX-License-Identifier: Apache-2.0
#include "files/scratch_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>

namespace clew::files {
namespace {

namespace fs = std::filesystem;

/// What stands for the letters that are chosen for each folder.
constexpr std::string_view kLetters = "XXXXXX";
/// After so many a folder does without a lock.
constexpr int kTries = 4;

/// The folder, open and locked; -1: another process has it, or it is not there, or not ours.
int locked(const std::string& path) {
  const int folder = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder < 0) return -1;
  struct stat open {};
  struct stat named {};
  const bool is_ours = ::fstat(folder, &open) == 0 && open.st_uid == ::geteuid() &&
                       ::flock(folder, LOCK_EX | LOCK_NB) == 0;
  // Whoever had the lock before may have removed it.
  if (is_ours && ::lstat(path.c_str(), &named) == 0 && named.st_ino == open.st_ino) return folder;
  ::close(folder);
  return -1;
}

void remove(const std::string& path, int lock) {
  std::error_code ignored;
  fs::remove_all(path, ignored);
  ::close(lock);
}

/// Removes folders whose names begin so, and whose processes were killed.
void remove_left(const fs::path& place, const std::string& begin) {
  std::error_code ignored;
  for (fs::directory_iterator at(place, fs::directory_options::skip_permission_denied, ignored);
       !ignored && at != fs::directory_iterator(); at.increment(ignored)) {
    const std::string name = at->path().filename().string();
    if (name.size() != begin.size() + kLetters.size()) continue;
    if (name.compare(0, begin.size(), begin) != 0) continue;
    const int lock = locked(at->path().string());
    if (lock >= 0) remove(at->path().string(), lock);
  }
}

}  // namespace

core::Result<ScratchFolder> ScratchFolder::make(const std::string& prefix) {
  std::error_code code;
  const auto place = fs::temp_directory_path(code);
  if (code) {
    const char* const named = std::getenv("TMPDIR");
    return core::Error{"is no folder for temporary files: " + code.message() +
                           "; set TMPDIR to one that can be written",
                       named == nullptr ? "/tmp" : named};
  }
  const std::string begin = prefix + '.';
  remove_left(place, begin);
  for (int tries = 1;; ++tries) {
    std::string path = (place / (begin + std::string(kLetters))).string();
    if (::mkdtemp(path.data()) == nullptr) {
      return core::Error{std::string("cannot be made: ") + std::strerror(errno) +
                             "; set TMPDIR to a folder that can be written",
                         path};
    }
    // Another process may just remove it as one that was left. Where nothing can be locked, nothing
    // is removed.
    const int lock = locked(path);
    if (lock >= 0 || (tries >= kTries && fs::exists(path, code))) {
      return ScratchFolder(std::move(path), lock);
    }
    ::rmdir(path.c_str());
  }
}

ScratchFolder::~ScratchFolder() {
  if (path_.empty()) return;
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace clew::files
