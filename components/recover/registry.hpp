// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "recover/detectors/trap_detector.hpp"
#include "recover/escapes/escape.hpp"
#include "runtime/registry.hpp"

namespace clew::recover {

/// All detectors; those of plug-ins, once they are loaded, stand behind ours.
runtime::Registry<TrapDetector>& detectors();

/// All escapes; those of plug-ins, once they are loaded, stand behind ours.
runtime::Registry<Escape>& escapes();

}  // namespace clew::recover
