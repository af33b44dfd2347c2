// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"
#include "runtime/config_source.hpp"

namespace clew::bench {

/// The worlds that a suite means by `pattern`, sorted: a name of configs/worlds or a path, with a
/// shell's wildcards `*`, `?` and `[...]`. A path begins at the working directory, as everywhere.
/// Without wildcards it is the pattern itself, there or not. Refused: a pattern that nothing
/// matches.
core::Result<std::vector<std::string>> world_names(const std::string& pattern,
                                                   const runtime::ConfigPath& configs);

/// A world's name as part of a file's: what stands for a folder, is hidden or is no plain letter,
/// digit, dot, dash or underscore becomes a dash.
std::string file_name_of(const std::string& world);

}  // namespace clew::bench
