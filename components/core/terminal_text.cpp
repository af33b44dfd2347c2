// SPDX-License-Identifier: Apache-2.0
#include "core/terminal_text.hpp"

#include <cstddef>

namespace clew::core {
namespace {

/// How many bytes of a letter in UTF-8 follow its first one; 0 too if it is none.
std::size_t following(unsigned char first) {
  if (first < 0xc2) return 0;
  if (first < 0xe0) return 1;
  if (first < 0xf0) return 2;
  return first < 0xf5 ? 3 : 0;
}

bool is_following(unsigned char code) { return (code & 0xc0U) == 0x80U; }

/// The bytes of the letter at the front, which may be one that is no UTF-8.
std::size_t letter_bytes(std::string_view text) {
  const std::size_t more = following(static_cast<unsigned char>(text[0]));
  if (text.size() <= more) return 1;
  for (std::size_t i = 1; i <= more; ++i) {
    if (!is_following(static_cast<unsigned char>(text[i]))) return 1;
  }
  return 1 + more;
}

bool commands(std::string_view letter) {
  const auto first = static_cast<unsigned char>(letter[0]);
  if (letter.size() == 1) return first < ' ' || first == 0x7f || (first >= 0x80 && first < 0xa0);
  return first == 0xc2 && static_cast<unsigned char>(letter[1]) < 0xa0;
}

std::string shown(std::string_view text, std::string_view kept) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const std::string_view letter = text.substr(0, letter_bytes(text));
    text.remove_prefix(letter.size());
    if (!commands(letter) || kept.find(letter) != std::string_view::npos) {
      out += letter;
      continue;
    }
    for (const char c : letter) {
      const auto code = static_cast<unsigned char>(c);
      out += {'\\', 'x', kDigits[code >> 4], kDigits[code & 15]};
    }
  }
  return out;
}

}  // namespace

std::string terminal_text(std::string_view text) { return shown(text, {}); }

std::string terminal_lines(std::string_view text) { return shown(text, "\n\t"); }

}  // namespace clew::core
