// SPDX-License-Identifier: Apache-2.0
#include "clew/terminal.hpp"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

#include "log/log.hpp"

namespace clew::tools {

bool is_terminal(int file) {
  if (::isatty(file) == 0) return false;
  const char* const kind = std::getenv("TERM");
  return kind == nullptr || std::string_view(kind) != "dumb";
}

bool shows_progress() { return is_terminal(STDERR_FILENO) && logs::shows(logs::Level::kInfo); }

}  // namespace clew::tools
