// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plan/planner.hpp"
#include "runtime/registry.hpp"

namespace clew::plan {

/// All planners.
const runtime::Registry<Planner>& planners();

}  // namespace clew::plan
