// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace clew::hunt {

/// A text as a YAML file has it between quotes, on one line.
inline std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return out + '"';
}

}  // namespace clew::hunt
