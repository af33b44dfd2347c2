// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "runtime/stage.hpp"

namespace clew::stages {

/// All stages, in the order of the flow.
const std::vector<runtime::StageInfo>& all();

}  // namespace clew::stages
