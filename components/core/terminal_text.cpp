// SPDX-License-Identifier: Apache-2.0
#include "core/terminal_text.hpp"

namespace clew::core {

std::string terminal_text(std::string_view text, LineEnds line_ends) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string shown;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto code = static_cast<unsigned char>(text[i]);
    // U+0080 to U+009F, two bytes in UTF-8, command some terminals as well.
    const bool is_c1 =
        code == 0xc2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0;
    const bool is_kept = code == '\n' && line_ends == LineEnds::kKept;
    if ((code < ' ' && !is_kept) || code == 0x7f || is_c1) {
      shown += {'\\', 'x', kDigits[code >> 4U], kDigits[code & 15U]};
    } else {
      shown += text[i];
    }
  }
  return shown;
}

}  // namespace clew::core
