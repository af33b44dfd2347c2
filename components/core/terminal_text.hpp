// SPDX-License-Identifier: Apache-2.0
/// A stranger's text, where it is printed. Bytes that command a terminal, U+0000 to U+001F, U+007F
/// and U+0080 to U+009F, in UTF-8 or alone, are written as `\x1b`. What was written so stays as it
/// is.
#pragma once

#include <string>
#include <string_view>

namespace clew::core {

/// As a part of a line.
std::string terminal_text(std::string_view text);
/// As lines: ends of lines and tabs stay.
std::string terminal_lines(std::string_view text);

}  // namespace clew::core
