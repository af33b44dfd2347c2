// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/stage.hpp"

namespace clew::control {

/// The declarations of *control*, and how to make its component.
const runtime::StageInfo& stage();

}  // namespace clew::control
