// SPDX-License-Identifier: Apache-2.0
#include "clew/terminal_text.hpp"

#include <fmt/format.h>

namespace clew::tools {

std::string terminal_text(std::string_view text) {
  std::string shown;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto code = static_cast<unsigned char>(text[i]);
    // U+0080 to U+009F, two bytes in UTF-8, command some terminals as well.
    const bool is_c1 =
        code == 0xc2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0;
    if (code < ' ' || code == 0x7f || is_c1) {
      shown += fmt::format("\\x{:02x}", static_cast<unsigned>(code));
    } else {
      shown += text[i];
    }
  }
  return shown;
}

}  // namespace clew::tools
