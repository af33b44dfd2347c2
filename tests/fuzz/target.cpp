// SPDX-License-Identifier: Apache-2.0
#include "target.hpp"

#include <algorithm>
#include <filesystem>

#include "tests/source_files.hpp"

namespace clew::fuzz {

std::vector<Target> all_targets() {
  std::vector<Target> all;
  for (const auto& some : {text_targets(), picture_targets(), recording_targets(), wire_targets(),
                           line_targets(), state_targets()}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

Seeds files(const std::vector<std::string>& paths) {
  Seeds seeds;
  for (const std::string& path : paths) {
    seeds.push_back(tests::file_of(path).text);
    CLEW_CHECK(!seeds.back().empty(), path + " is not there");
  }
  return seeds;
}

Seeds files_of(const std::string& folder, const std::string& ending, std::size_t most_bytes) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(tests::source_path(folder))) {
    if (entry.path().extension() != ending || entry.file_size() > most_bytes) continue;
    paths.push_back(folder + '/' + entry.path().filename().string());
  }
  std::sort(paths.begin(), paths.end());  // a folder has no order of its own
  return files(paths);
}

}  // namespace clew::fuzz
