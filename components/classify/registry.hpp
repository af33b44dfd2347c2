// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "classify/classifier.hpp"
#include "runtime/registry.hpp"

namespace clew::classify {

/// All classifiers; those of plug-ins, once they are loaded, stand behind ours.
runtime::Registry<Classifier>& classifiers();

}  // namespace clew::classify
