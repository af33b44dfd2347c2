// SPDX-License-Identifier: Apache-2.0
#include "clew/terminal.hpp"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace clew::tools {

bool is_terminal(int file) {
  if (::isatty(file) == 0) return false;
  const char* const kind = std::getenv("TERM");
  return kind == nullptr || std::string_view(kind) != "dumb";
}

}  // namespace clew::tools
