// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "clew/run_options.hpp"

namespace clew::tools {

/// The options of `clew run` that say how, and not what, it runs.
void add_run_arguments(CLI::App& app, RunOptions& options);

}  // namespace clew::tools
