// SPDX-License-Identifier: Apache-2.0
#include "runtime/user_folders.hpp"

#include <cstdlib>

namespace clew::runtime {
namespace {

std::optional<std::string> absolute_path_in(const char* variable) {
  const char* const path = std::getenv(variable);
  if (path == nullptr || *path != '/') return std::nullopt;
  return path;
}

}  // namespace

std::optional<std::string> user_config_folder() {
  if (const auto config = absolute_path_in("XDG_CONFIG_HOME")) return *config + "/clew";
  if (const auto home = absolute_path_in("HOME")) return *home + "/.config/clew";
  return std::nullopt;
}

}  // namespace clew::runtime
