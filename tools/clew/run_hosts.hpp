// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "clew/run_options.hpp"
#include "core/result.hpp"
#include "runtime/graph.hpp"
#include "supervisor/process_layout.hpp"

namespace clew::tools {

/// On which hosts the processes of a graph run, as the options and the graph have it: added to the
/// layout, which stays as it is if all run here. Refused: hosts that the file does not know, a
/// process on two hosts, and stages that cannot be elsewhere.
core::Result<void> read_hosts(const RunOptions& options, const runtime::Graph& graph,
                              bridge::ProcessLayout& layout);

}  // namespace clew::tools
