// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "recover/escape.hpp"
#include "recover/trap_detector.hpp"
#include "runtime/registry.hpp"

namespace clew::recover {

/// All detectors.
const runtime::Registry<TrapDetector>& detectors();

/// All escapes.
const runtime::Registry<Escape>& escapes();

}  // namespace clew::recover
