// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/stage.hpp"

namespace clew::classify {

/// The declarations of *classify*, and how to make its component.
const runtime::StageInfo& stage();

}  // namespace clew::classify
