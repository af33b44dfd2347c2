// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace clew::tools {

/// Puts the commands of the program under headings, and examples and the environment at the end of
/// its help.
void add_help(CLI::App& main);

}  // namespace clew::tools
