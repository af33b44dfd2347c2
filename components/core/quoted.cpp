// SPDX-License-Identifier: Apache-2.0
#include "core/quoted.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace clew::core {
namespace {

/// Between two of `quote`, with `escape` in place of a quote inside.
std::string between(char quote, const char* escape, const std::string& text) {
  std::string quoted(1, quote);
  for (const char c : text) {
    if (c == quote) {
      quoted += escape;
    } else {
      quoted += c;
    }
  }
  return quoted + quote;
}

}  // namespace

std::string yaml_quoted(const std::string& text) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < ' ' || byte == 0x7f) {
      quoted += {'\\', 'x', kDigits[byte / 16], kDigits[byte % 16]};
      continue;
    }
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::string shell_word(const std::string& word) {
  const bool plain = std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return c < 0x80 &&
           (std::isalnum(c) != 0 || (c != 0 && std::strchr("_-./=:,@%+", c) != nullptr));
  });
  return plain && !word.empty() ? word : between('\'', "'\\''", word);
}

std::string csv_field(const std::string& text) {
  return text.find_first_of(",\"\r\n") == std::string::npos ? text : between('"', "\"\"", text);
}

}  // namespace clew::core
