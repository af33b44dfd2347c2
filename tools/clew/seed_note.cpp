// SPDX-License-Identifier: Apache-2.0
#include "clew/seed_note.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>
#include <vector>

namespace clew::tools {

std::string seed_note(const runtime::Graph& graph) {
  return fmt::format(
      "seed {} gives the run of every seed: no noise, drift or slip is on that goes by chance",
      graph.seed);
}

bool goes_by_chance(const runtime::Graph& graph) {
  static const std::vector<std::string> kOfChance = {
      "noise_stddev_m",       "outlier_ratio",          "drop_out_ratio",    "drift_m_per_sqrt_m",
      "drift_rad_per_sqrt_m", "drift_rad_per_sqrt_rad", "slip_m_per_sqrt_m", "slip_rad_per_sqrt_m"};
  const auto is_on = [](const core::ParameterValues& values) {
    return std::any_of(kOfChance.begin(), kOfChance.end(), [&](const std::string& name) {
      const auto found = values.find(name);
      const double* number = found == values.end() ? nullptr : std::get_if<double>(&found->second);
      return number != nullptr && *number != 0.0;
    });
  };
  for (const runtime::GraphStage& stage : graph.stages) {
    // What others wrote may throw dice of its own.
    if (!stage.deployment.is_ours() || is_on(stage.config.parameters)) return true;
    for (const auto& [part, choices] : stage.config.parts) {
      for (const auto& choice : choices) {
        if (is_on(choice.parameters)) return true;
      }
    }
  }
  return false;
}

}  // namespace clew::tools
