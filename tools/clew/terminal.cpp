// SPDX-License-Identifier: Apache-2.0
#include "clew/terminal.hpp"

#include <unistd.h>

#include <cstdlib>
#include <string>
#include <string_view>

#include "log/log.hpp"

namespace clew::tools {

bool is_terminal(int file) {
  if (::isatty(file) == 0) return false;
  const char* const kind = std::getenv("TERM");
  return kind == nullptr || std::string_view(kind) != "dumb";
}

bool shows_colour(int file) {
  const char* const off = std::getenv("NO_COLOR");
  return is_terminal(file) && (off == nullptr || *off == '\0');
}

std::string in_colour(const std::string& word, Tone tone) {
  if (!shows_colour(STDOUT_FILENO)) return word;
  const char* const colour = tone == Tone::kGood ? "32" : tone == Tone::kBad ? "31" : "33";
  return "\033[" + std::string(colour) + 'm' + word + "\033[0m";
}

bool shows_progress() { return is_terminal(STDERR_FILENO) && logs::shows(logs::Level::kInfo); }

}  // namespace clew::tools
