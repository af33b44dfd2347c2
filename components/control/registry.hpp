// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "control/controller.hpp"
#include "runtime/registry.hpp"

namespace clew::control {

/// All controllers.
const runtime::Registry<Controller>& controllers();

}  // namespace clew::control
