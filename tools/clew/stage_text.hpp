// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "runtime/graph.hpp"

namespace clew::tools {

/// What a stage is made of, in a line: `detector landmark_revisit, escape obstacle_following`.
std::string stage_text(const runtime::GraphStage& stage);

}  // namespace clew::tools
