// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/result.hpp"
#include "runtime/graph.hpp"

namespace clew::runtime {

/// Connects the ports of a graph's stages by topic, notes optional ones that nobody writes, and
/// puts the stages in an order in which they can run within a tick. Errors name the place of a
/// stage.
core::Result<void> wire(Graph& graph);

}  // namespace clew::runtime
