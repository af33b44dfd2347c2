// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "core/result.hpp"

namespace clew::files {

/// A new folder among the temporary ones, which goes with this object, and all that is in it. That
/// of a process that was killed goes when the next one of its prefix is made: the folder of a
/// process that goes on is locked.
class ScratchFolder {
 public:
  /// Its name begins with `prefix`.
  static core::Result<ScratchFolder> make(const std::string& prefix);
  ScratchFolder(ScratchFolder&& other) noexcept
      : path_(std::exchange(other.path_, {})), lock_(std::exchange(other.lock_, -1)) {}
  ScratchFolder& operator=(ScratchFolder&&) = delete;
  ~ScratchFolder();

  const std::string& path() const { return path_; }

 private:
  ScratchFolder(std::string path, int lock) : path_(std::move(path)), lock_(lock) {}

  std::string path_;
  int lock_;  ///< the folder, held open
};

}  // namespace clew::files
