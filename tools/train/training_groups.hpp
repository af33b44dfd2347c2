// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "runtime/config_source.hpp"
#include "train/neuro_fuzzy_training.hpp"

namespace clew::train {

/// What runs showed for training the neuro-fuzzy networks, and where it comes from.
struct ShownGroups {
  std::vector<TrainingGroup> groups;
  std::string origin;  ///< lines of YAML, for the trained file
};

/// Puts a robot with infrared rangers at random free places of the recipe's worlds; the groups are
/// what it reads there and the expert's opinion of that. A run would show little of what is near,
/// since the expert keeps away from it.
core::Result<ShownGroups> groups_of_expert(const NeuroFuzzyRecipe& recipe,
                                           const runtime::ConfigPath& path);

/// The groups of a recorded run: its readings and the wheel speeds of its commands. Refused: what
/// is no recording, sensors other than four infrared rangers, and recordings without scans or
/// commands.
core::Result<ShownGroups> groups_of_recording(const NeuroFuzzyRecipe& recipe,
                                              const std::string& file);

}  // namespace clew::train
