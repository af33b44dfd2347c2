// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "recover/detectors/trap_detector.hpp"
#include "recover/escapes/escape.hpp"
#include "runtime/registry.hpp"

namespace clew::recover {

/// All detectors.
const runtime::Registry<TrapDetector>& detectors();

/// All escapes.
const runtime::Registry<Escape>& escapes();

}  // namespace clew::recover
