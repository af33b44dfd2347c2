// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/stage.hpp"

namespace clew::plan {

/// The stage *plan*.
const runtime::StageInfo& stage();

}  // namespace clew::plan
