// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "control/neuro_fuzzy_training.hpp"
#include "runtime/config_source.hpp"

namespace clew::tools {

/// What runs showed for training the neuro-fuzzy networks, and where it comes from.
struct ShownGroups {
  std::vector<control::TrainingGroup> groups;
  std::string origin;  ///< lines of YAML, for the trained file
};

/// Puts a robot with infrared rangers at random free places of the recipe's worlds; the groups are
/// what it reads there and the expert's opinion of that. A run would show little of what is near,
/// since the expert keeps away from it.
core::Result<ShownGroups> groups_of_expert(const control::NeuroFuzzyRecipe& recipe,
                                           const runtime::ConfigPath& path);

/// The groups of a recorded run: its readings and the wheel speeds of its commands. Refused: what
/// is no recording, sensors other than four infrared rangers, and recordings without scans or
/// commands.
core::Result<ShownGroups> groups_of_recording(const control::NeuroFuzzyRecipe& recipe,
                                              const std::string& file);

}  // namespace clew::tools
