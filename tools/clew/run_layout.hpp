// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "clew/run_options.hpp"
#include "core/result.hpp"
#include "run/pace.hpp"
#include "runtime/graph.hpp"
#include "supervisor/process_layout.hpp"

namespace clew::tools {

/// How fast a run shall go.
struct Speed {
  bridge::Pace pace = bridge::Pace::kLockstep;
  double factor = 1.0;
};

/// Reads `--pace`.
core::Result<Speed> read_pace(const std::string& text);

/// How a graph is to be run as processes, as the options have it. Refused: stages and vendors that
/// do not exist, what is given twice, and what the stages of one process cannot have each for
/// itself.
core::Result<bridge::ProcessLayout> read_layout(const RunOptions& options,
                                                const runtime::Graph& graph, const Speed& speed);

/// One vendor's name, or each stage with its own.
std::string middleware_text(const runtime::Graph& graph, const bridge::ProcessLayout& layout);

}  // namespace clew::tools
