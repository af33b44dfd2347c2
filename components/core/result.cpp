// SPDX-License-Identifier: Apache-2.0
#include "core/result.hpp"

#include "core/terminal_text.hpp"

namespace clew::core {

std::string Error::text() const {
  std::string place = file;
  if (line > 0) {
    place += ':' + std::to_string(line);
    if (column > 0) place += ':' + std::to_string(column);
  }
  return terminal_lines(place.empty() ? message : place + ": " + message);
}

}  // namespace clew::core
