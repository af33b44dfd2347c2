// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace clew::tools {

/// A stranger's text for a terminal: bytes that would command it are written as `\x1b`.
std::string terminal_text(std::string_view text);

}  // namespace clew::tools
