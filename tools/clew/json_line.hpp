// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace clew::tools {

/// One line of JSON; bytes that are no UTF-8, which a recording may hold, are replaced, and letters
/// that command terminals are written as `\u009b`.
inline std::string json_line(const nlohmann::ordered_json& json) {
  const std::string text =
      json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string line;
  line.reserve(text.size());
  // JSON writes those below U+0020 so by itself; the others stand in texts alone.
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto code = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    if (code == 0x7f) {
      line += "\\u007f";
    } else if (code == 0xc2 && next < 0xa0) {
      line += next < 0x90 ? "\\u008" : "\\u009";
      line += "0123456789abcdef"[next & 15U];
      ++i;
    } else {
      line += text[i];
    }
  }
  return line;
}

}  // namespace clew::tools
