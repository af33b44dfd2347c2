// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "run/pace.hpp"
#include "runtime/graph.hpp"

namespace clew::tools {

/// Refused: a graph with a third-party program that is not there or whose interpreter is not,
/// unless a person starts it.
core::Result<void> check_programs(const runtime::Graph& graph,
                                  const std::vector<std::string>& external);

/// A recording may come from a stranger. Refused: a program that it would start, unless the user
/// has named it, too: `named` holds command lines, their words joined by blanks. Of all stages, or
/// of `component` alone.
core::Result<void> check_programs_are_named(const runtime::Graph& graph,
                                            const std::vector<std::string>& named,
                                            const std::string& component = {});

/// Refused: a command before a component whose program is not there.
core::Result<void> check_prefix(const std::string& command);

/// Refused: a factor of simulated time with a drive that is on the wire itself, which keeps its own
/// pace.
core::Result<void> check_pace(const runtime::Graph& graph, bridge::Pace pace);

}  // namespace clew::tools
