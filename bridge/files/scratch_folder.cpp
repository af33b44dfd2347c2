// SPDX-License-Identifier: Apache-2.0
#include "files/scratch_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace clew::files {

core::Result<ScratchFolder> ScratchFolder::make(const std::string& prefix) {
  std::error_code code;
  const auto folder = std::filesystem::temp_directory_path(code);
  if (code) {
    const char* const named = std::getenv("TMPDIR");
    return core::Error{"is no folder for temporary files: " + code.message() +
                           "; set TMPDIR to one that can be written",
                       named == nullptr ? "/tmp" : named};
  }
  std::string path = (folder / (prefix + "-XXXXXX")).string();
  if (::mkdtemp(path.data()) == nullptr) {
    return core::Error{std::string("cannot be made: ") + std::strerror(errno) +
                           "; set TMPDIR to a folder that can be written",
                       path};
  }
  return ScratchFolder(std::move(path));
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace clew::files
