// SPDX-License-Identifier: Apache-2.0
#include "core/yaml_fields.hpp"
#include "train/neuro_fuzzy_training.hpp"

namespace clew::train {
namespace {

using core::Result;
using core::YamlNode;

constexpr std::int64_t kMostCount = 10'000'000;

Result<void> read_groups(const YamlNode& root, NeuroFuzzyRecipe& recipe) {
  const auto node = root.at("groups");
  if (!node.ok()) return node.error();
  CLEW_RETURN_IF_ERROR(node->check_keys({"train", "test"}));
  CLEW_RETURN_IF_ERROR(core::read_count(*node, "train", 1, kMostCount, recipe.train_groups));
  return core::read_count(*node, "test", 1, kMostCount, recipe.test_groups);
}

/// The key's value, one of two words: whether it is the second. The first where it is missing.
Result<bool> read_second(const YamlNode& root, const char* key, const std::string& first,
                         const std::string& second) {
  const auto node = root.find(key);
  if (!node) return false;
  const auto word = node->string();
  if (!word.ok()) return word.error();
  if (*word == first || *word == second) return *word == second;
  return node->error("found '" + *word + "'; allowed: " + first + ", " + second);
}

Result<void> read_start(const YamlNode& root, NeuroFuzzyRecipe& recipe) {
  const auto sets = read_second(root, "sets", "rules", "readings");
  if (!sets.ok()) return sets.error();
  const auto outputs = read_second(root, "outputs", "rules", "random");
  if (!outputs.ok()) return outputs.error();
  const auto learn = read_second(root, "learn", "wheels", "networks");
  if (!learn.ok()) return learn.error();
  recipe.sets = *sets ? StartSets::kReadings : StartSets::kRules;
  recipe.outputs = *outputs ? StartOutputs::kRandom : StartOutputs::kRules;
  recipe.each_network = *learn;
  return {};
}

Result<void> read_rates(const YamlNode& root, NeuroFuzzyRecipe& recipe) {
  const auto node = root.at("learning_rates");
  if (!node.ok()) return node.error();
  CLEW_RETURN_IF_ERROR(node->check_keys({"centres", "widths", "outputs"}));
  CLEW_RETURN_IF_ERROR(core::read_number(*node, "centres", {0.0, 1e6}, recipe.rate_centres));
  CLEW_RETURN_IF_ERROR(core::read_number(*node, "widths", {0.0, 1e6}, recipe.rate_widths));
  return core::read_number(*node, "outputs", {0.0, 1.0}, recipe.rate_outputs);
}

}  // namespace

Result<NeuroFuzzyRecipe> NeuroFuzzyRecipe::parse(const core::Resource& resource) {
  const auto root = YamlNode::parse(resource.text, resource.file);
  if (!root.ok()) return root.error();
  CLEW_RETURN_IF_ERROR(root->check_keys({"format", "seed", "start", "sets", "outputs", "learn",
                                         "groups", "iterations", "tolerance_mps", "learning_rates",
                                         "wheel_base_m", "places", "worlds"}));
  CLEW_RETURN_IF_ERROR(core::check_format(*root, "clew-neuro-fuzzy-training/1"));
  NeuroFuzzyRecipe recipe;
  CLEW_RETURN_IF_ERROR(core::read_count(*root, "seed", 0, kMostCount, recipe.seed));
  const auto start = root->at("start");
  if (!start.ok()) return start.error();
  const auto name = start->string();
  if (!name.ok()) return name.error();
  recipe.start = *name;
  CLEW_RETURN_IF_ERROR(read_start(*root, recipe));
  CLEW_RETURN_IF_ERROR(read_groups(*root, recipe));
  CLEW_RETURN_IF_ERROR(core::read_count(*root, "iterations", 1, kMostCount, recipe.iterations));
  CLEW_RETURN_IF_ERROR(core::read_number(*root, "tolerance_mps", {0.0, 1.0}, recipe.tolerance_mps));
  CLEW_RETURN_IF_ERROR(read_rates(*root, recipe));
  CLEW_RETURN_IF_ERROR(core::read_number(*root, "wheel_base_m", {0.01, 5.0}, recipe.wheel_base_m));
  CLEW_RETURN_IF_ERROR(core::read_count(*root, "places", 1, kMostCount, recipe.places));
  CLEW_RETURN_IF_ERROR(core::read_names(*root, "worlds", recipe.worlds));
  return recipe;
}

}  // namespace clew::train
