// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "control/controller.hpp"
#include "control/reactions/reaction.hpp"
#include "runtime/registry.hpp"

namespace clew::control {

/// All controllers; those of plug-ins, once they are loaded, stand behind ours.
runtime::Registry<Controller>& controllers();

/// All reactions.
runtime::Registry<Reaction>& reactions();

}  // namespace clew::control
