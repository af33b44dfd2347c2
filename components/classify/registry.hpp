// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "classify/classifier.hpp"
#include "runtime/registry.hpp"

namespace clew::classify {

/// All classifiers.
const runtime::Registry<Classifier>& classifiers();

}  // namespace clew::classify
