// SPDX-License-Identifier: Apache-2.0
#include "clew/typed_line.hpp"

#include "core/quoted.hpp"

namespace clew::tools {

std::string typed_line(const std::vector<std::string>& words) {
  std::string line = "clew";
  for (const std::string& word : words) line += ' ' + core::shell_word(word);
  return line;
}

}  // namespace clew::tools
