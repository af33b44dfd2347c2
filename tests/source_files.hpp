// SPDX-License-Identifier: Apache-2.0
/// Files of the source tree, as behaviours get them.
#pragma once

#include <fstream>
#include <iterator>
#include <string>

#include "core/resources.hpp"
#include "tests/source_path.hpp"

namespace clew::tests {

/// By its path from the project's root.
inline core::Resource file_of(const std::string& path) {
  std::ifstream stream(tests::source_path(path), std::ios::binary);
  return {path.substr(path.rfind('/') + 1),
          {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()}};
}

/// By its name alone.
inline core::Resource rule_base(const std::string& name) {
  return file_of("configs/rulebases/" + name + ".yaml");
}

/// The text with one occurrence replaced.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace clew::tests
