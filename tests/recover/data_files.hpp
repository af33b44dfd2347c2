// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <iterator>
#include <string>

#include "core/resources.hpp"

namespace clew::recover {

/// A rule base of the source tree, as a behaviour gets it.
inline core::Resource rule_base(const std::string& name) {
  std::ifstream stream(CLEW_SOURCE_DIR "/configs/rulebases/" + name + ".yaml", std::ios::binary);
  return {name + ".yaml",
          {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()}};
}

/// The text with one occurrence replaced.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace clew::recover
