// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace clew::core {

enum class LineEnds : std::uint8_t { kEscaped, kKept };

/// A stranger's text for a terminal or a log: bytes that would command it are written as `\x1b`.
std::string terminal_text(std::string_view text, LineEnds line_ends = LineEnds::kEscaped);

}  // namespace clew::core
