// SPDX-License-Identifier: Apache-2.0
/// Who may include what: the layers of ARCHITECTURE.md.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "source_tree.hpp"

namespace clew::structure {

/// The headers of the project, as they are included: `core/angle.hpp`, `dds/participant.hpp`.
std::set<std::string> own_headers(const std::vector<SourceFile>& tree);

/// Components and bridge include only their own layer and those below it; behaviours include
/// neither the runtime nor another stage. Headers are included by the path of their folder.
std::vector<std::string> check_layers(const SourceFile& file, const std::set<std::string>& own);

/// The runtime names no stage in its texts: what it knows of stages, they declare in a StageInfo.
std::vector<std::string> check_runtime_texts(const SourceFile& file);

/// The headers of the DDS libraries are included in the folder that wraps them, and in tests.
std::vector<std::string> check_vendor_headers(const SourceFile& file,
                                              const std::set<std::string>& own);

}  // namespace clew::structure
