// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace clew::tools {

/// To the command `world`.
void add_world_severity(CLI::App& world, int& status);

}  // namespace clew::tools
