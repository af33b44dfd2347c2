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
  std::string path = (folder / (prefix + "-XXXXXX")).string();
  if (code || ::mkdtemp(path.data()) == nullptr) {
    return core::Error{std::string("cannot be made: ") + std::strerror(errno), path};
  }
  return ScratchFolder(std::move(path));
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace clew::files
