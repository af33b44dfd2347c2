// SPDX-License-Identifier: Apache-2.0
#include "bench/world_names.hpp"

#include <fnmatch.h>
#include <glob.h>

#include <filesystem>

namespace clew::bench {
namespace {

constexpr std::size_t kMostBytes = 120;  // a file's name may have 255

std::vector<std::string> files_like(const std::string& pattern) {
  glob_t found{};
  std::vector<std::string> files;
  if (::glob(pattern.c_str(), 0, nullptr, &found) == 0) {
    for (std::size_t i = 0; i < found.gl_pathc; ++i) {
      const std::filesystem::path path = found.gl_pathv[i];
      std::error_code ignored;
      if (path.extension() != ".yaml" || std::filesystem::is_directory(path, ignored)) continue;
      files.push_back(path.string());
    }
  }
  ::globfree(&found);
  return files;
}

std::vector<std::string> names_like(const std::string& pattern,
                                    const runtime::ConfigPath& configs) {
  std::vector<std::string> names;
  for (const std::string& name : configs.names("worlds")) {
    if (::fnmatch(pattern.c_str(), name.c_str(), 0) == 0) names.push_back(name);
  }
  return names;
}

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
         c == '-' || c == '_';
}

}  // namespace

core::Result<std::vector<std::string>> world_names(const std::string& pattern,
                                                   const runtime::ConfigPath& configs) {
  if (pattern.find_first_of("*?[") == std::string::npos) {
    return std::vector<std::string>{pattern};
  }
  const bool is_path = pattern.find('/') != std::string::npos;
  auto names = is_path ? files_like(pattern) : names_like(pattern, configs);
  if (!names.empty()) return names;
  return core::Error{is_path ? "no .yaml file matches '" + pattern +
                                   "' (a path from the working directory, " +
                                   std::filesystem::current_path().string() + ')'
                             : "no world's name matches '" + pattern + "'"};
}

std::string file_name_of(const std::string& world) {
  std::string name = world.substr(0, kMostBytes);
  for (char& c : name) {
    if (!is_plain(c)) c = '-';
  }
  if (!name.empty() && name.front() == '.') name.front() = '-';
  return name;
}

}  // namespace clew::bench
