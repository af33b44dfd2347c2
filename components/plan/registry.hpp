// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plan/planner.hpp"
#include "runtime/registry.hpp"

namespace clew::plan {

/// All planners; those of plug-ins, once they are loaded, stand behind ours.
runtime::Registry<Planner>& planners();

}  // namespace clew::plan
