// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/stage.hpp"

namespace clew::drive {

/// The declarations of *drive*, and how to make its component.
const runtime::StageInfo& stage();

}  // namespace clew::drive
