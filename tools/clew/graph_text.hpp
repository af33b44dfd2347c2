// SPDX-License-Identifier: Apache-2.0
/// A graph for programs: as JSON, and as a drawing of Graphviz.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "runtime/run_plan.hpp"

namespace clew::tools {

/// What `clew check` says of a graph: its stages with what they are made of, and its wiring.
nlohmann::ordered_json json_of(const runtime::RunPlan& plan);

/// The graph in the language of `dot`: a box a stage, an arrow a topic and reader, dashed where the
/// reader gets it a tick later.
std::string dot_of(const runtime::Graph& graph);

}  // namespace clew::tools
