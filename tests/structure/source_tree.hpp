// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace clew::structure {

/// A file of the project, as the rules see it.
struct SourceFile {
  std::string path;  ///< from the root of the source tree: `components/core/angle.hpp`
  std::vector<std::string> lines;

  /// The words of the path between slashes, the file's name last.
  std::vector<std::string> path_parts() const;
  /// The name without folder and extension.
  std::string stem() const;
  /// With its dot: `.hpp`.
  std::string extension() const;
};

/// A text as a file, for the tests of the rules.
SourceFile source_file(const std::string& path, const std::string& text);

/// All files under these folders of the source tree, sorted by path; what tools leave behind
/// (hidden directories, node_modules, __pycache__) is not there.
std::vector<SourceFile> read_tree(const std::filesystem::path& root,
                                  const std::vector<std::string>& folders);

/// A broken rule: `components/sense/cones.cpp:7: includes runtime/node.hpp; ...`.
std::string violation(const SourceFile& file, std::size_t line, const std::string& what);

}  // namespace clew::structure
