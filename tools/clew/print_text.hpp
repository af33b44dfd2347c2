// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "core/terminal_text.hpp"

namespace clew::tools {

using core::terminal_text;

/// As fmt::print, of what strangers may have written: it steers no terminal. Throws what that
/// throws.
template <typename... Values>
void print_text(std::FILE* file, fmt::format_string<Values...> format, Values&&... values) {
  fmt::print(file, "{}",
             core::terminal_lines(fmt::format(format, std::forward<Values>(values)...)));
}
template <typename... Values>
void print_text(fmt::format_string<Values...> format, Values&&... values) {
  print_text(stdout, format, std::forward<Values>(values)...);
}

}  // namespace clew::tools
