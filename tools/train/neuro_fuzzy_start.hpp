// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/result.hpp"
#include "train/neuro_fuzzy_training.hpp"

namespace clew::train {

/// The networks that training begins with: those of the rule base, or with their sets laid over
/// what the four sensors read in the training groups, or with random outputs, as the recipe says.
/// Sets that are laid have their centres evenly from the least reading to the greatest one, and a
/// width at which neighbours meet at a half. A network that ignores its second sensor goes on doing
/// so.
///
/// Refused: sets in which less than half of the readings lie, each within two widths of a centre.
/// No gradient leads back to them, so that training would make a controller of what is left over.
core::Result<NeuroFuzzyNets> start_networks(const NeuroFuzzyRecipe& recipe,
                                            const NeuroFuzzyNets& rules,
                                            const TrainingGroups& groups);

}  // namespace clew::train
