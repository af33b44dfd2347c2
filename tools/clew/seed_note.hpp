// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "runtime/graph.hpp"

namespace clew::tools {

/// Whether a run of this graph depends on its seed: only noise, drift and slip go by chance, and
/// what others wrote may.
bool goes_by_chance(const runtime::Graph& graph);

/// What to say where somebody gave a seed and nothing goes by chance.
std::string seed_note(const runtime::Graph& graph);

}  // namespace clew::tools
