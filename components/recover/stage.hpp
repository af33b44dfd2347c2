// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/stage.hpp"

namespace clew::recover {

/// The declarations of *recover*, and how to make its component.
const runtime::StageInfo& stage();

}  // namespace clew::recover
