// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "recording/run_recording.hpp"

namespace clew::tools {

/// The option --plugin.
void add_plugins(CLI::App& app, std::vector<std::string>& plugins);

/// Loads what --plugin named, then what the graph of that name does under `plugins`. A graph that
/// cannot be read is refused by who reads it.
core::Result<void> load_plugins_of(const std::vector<std::string>& plugins,
                                   const std::string& graph = {});

/// Loads what --plugin named, and nothing that the recording names. Says which plug-ins are not
/// those that the run was recorded with.
core::Result<void> load_plugins_for(const bridge::RunRecording& recording,
                                    const std::vector<std::string>& plugins);

}  // namespace clew::tools
