// SPDX-License-Identifier: Apache-2.0
#include "source_tree.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace clew::structure {
namespace {

namespace fs = std::filesystem;

bool is_left_behind(const fs::path& directory) {
  const std::string name = directory.filename().string();
  return name == "node_modules" || name == "__pycache__" || name.front() == '.';
}

}  // namespace

std::vector<std::string> SourceFile::path_parts() const {
  std::vector<std::string> parts;
  for (const fs::path& part : fs::path(path)) parts.push_back(part.string());
  return parts;
}

std::string SourceFile::stem() const { return fs::path(path).stem().string(); }

std::string SourceFile::extension() const { return fs::path(path).extension().string(); }

SourceFile source_file(const std::string& path, const std::string& text) {
  SourceFile file{path, {}};
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) file.lines.push_back(line);
  return file;
}

std::vector<SourceFile> read_tree(const fs::path& root, const std::vector<std::string>& folders) {
  std::vector<SourceFile> files;
  for (const std::string& folder : folders) {
    for (fs::recursive_directory_iterator it(root / folder), end; it != end; ++it) {
      if (it->is_directory() && is_left_behind(it->path())) it.disable_recursion_pending();
      if (!it->is_regular_file()) continue;
      std::ostringstream text;
      text << std::ifstream(it->path(), std::ios::binary).rdbuf();
      files.push_back(
          source_file(it->path().lexically_relative(root).generic_string(), text.str()));
    }
  }
  std::sort(files.begin(), files.end(),
            [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

std::string violation(const SourceFile& file, std::size_t line, const std::string& what) {
  return file.path + ':' + std::to_string(line) + ": " + what;
}

}  // namespace clew::structure
