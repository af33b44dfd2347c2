// SPDX-License-Identifier: Apache-2.0
#include "core/yaml_fields.hpp"
#include "train/som_training.hpp"

namespace clew::train {
namespace {

using classify::Som;
using core::Result;
using core::YamlNode;

constexpr std::int64_t kLeastIterations = 100 * static_cast<std::int64_t>(Som::kNeurons);
constexpr std::int64_t kMostIterations = 1'000'000'000;
constexpr core::Range kScaleStep = {0.01, 0.5};

/// A pair [first, last] with 0 < last <= first <= most, a whole number.
Result<void> read_annealed(const YamlNode& root, const char* key, int most,
                           std::array<double, 2>& field) {
  const auto node = root.at(key);
  if (!node.ok()) return node.error();
  const auto pair = node->numbers(2, "[first, last]");
  if (!pair.ok()) return pair.error();
  field = {(*pair)[0], (*pair)[1]};
  if (field[1] > 0.0 && field[1] <= field[0] && field[0] <= most) return {};
  return node->error("expected [first, last] with 0 < last <= first <= " + std::to_string(most));
}

}  // namespace

Result<SomRecipe> SomRecipe::parse(const core::Resource& resource) {
  const auto root = YamlNode::parse(resource.text, resource.file);
  if (!root.ok()) return root.error();
  CLEW_RETURN_IF_ERROR(
      root->check_keys({"format", "seed", "iterations", "learning_rate", "radius_neurons",
                        "least_runs_ticks", "scale_step", "worlds"}));
  CLEW_RETURN_IF_ERROR(core::check_format(*root, "clew-som-training/1"));
  SomRecipe recipe;
  CLEW_RETURN_IF_ERROR(core::read_count(*root, "seed", 0, kMostIterations, recipe.seed));
  CLEW_RETURN_IF_ERROR(
      core::read_count(*root, "iterations", kLeastIterations, kMostIterations, recipe.iterations));
  CLEW_RETURN_IF_ERROR(read_annealed(*root, "learning_rate", 1, recipe.learning_rate));
  CLEW_RETURN_IF_ERROR(read_annealed(*root, "radius_neurons", 7, recipe.radius_neurons));
  CLEW_RETURN_IF_ERROR(core::read_counts(*root, "least_runs_ticks", recipe.least_runs));
  CLEW_RETURN_IF_ERROR(core::read_number(*root, "scale_step", kScaleStep, recipe.scale_step));
  CLEW_RETURN_IF_ERROR(core::read_names(*root, "worlds", recipe.worlds));
  return recipe;
}

}  // namespace clew::train
