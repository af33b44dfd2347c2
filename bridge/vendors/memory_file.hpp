// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace clew::bridge {

/// A text that other processes of the same user can read as a file, and nobody change, while this
/// object lives. It is on no disk, so nothing is left of it, however the process ends.
class MemoryFile {
 public:
  MemoryFile(const std::string& name, const std::string& text);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::string& path() const { return path_; }
  /// Why there is no such file; empty if there is.
  const std::string& failure() const { return failure_; }

 private:
  int descriptor_;
  std::string path_;
  std::string failure_;
};

}  // namespace clew::bridge
