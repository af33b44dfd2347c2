// SPDX-License-Identifier: Apache-2.0
#include "fleet/output_folder.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace clew::fleet {

using core::Error;

core::Result<std::string> make_folder(const std::string& folder) {
  std::error_code code;
  const std::filesystem::path above = std::filesystem::path(folder).parent_path();
  if (!above.empty()) std::filesystem::create_directories(above, code);
  if (code) return Error{"the folder cannot be made: " + code.message(), above.string()};
  if (::mkdir(folder.c_str(), 0777) != 0 && errno != EEXIST) {
    return Error{"the folder cannot be made: " + std::generic_category().message(errno), folder};
  }
  char* const found = ::realpath(folder.c_str(), nullptr);
  if (found == nullptr) return Error{std::generic_category().message(errno), folder};
  std::string path = found;
  std::free(found);
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) return path;
  return Error{"found a file; allowed: a folder", folder};
}

core::Result<void> check_new_file(const std::string& path, bool force) {
  struct stat status {};
  if (force || ::lstat(path.c_str(), &status) != 0) return {};
  return Error{"the file exists; give --force to overwrite it", path};
}

}  // namespace clew::fleet
