// SPDX-License-Identifier: Apache-2.0
#include "control/neuro_fuzzy_training.hpp"
#include "core/yaml_fields.hpp"

namespace clew::control {
namespace {

using core::Result;
using core::YamlNode;

constexpr std::int64_t kMostCount = 10'000'000;

Result<void> read_count(const YamlNode& map, const char* key, std::int64_t least,
                        std::uint64_t& field) {
  const auto node = map.at(key);
  if (!node.ok()) return node.error();
  const auto number = node->integer();
  if (!number.ok()) return number.error();
  if (*number < least || *number > kMostCount) {
    return node->error("found " + node->found() + ", expected a whole number from " +
                       std::to_string(least) + " to " + std::to_string(kMostCount));
  }
  field = static_cast<std::uint64_t>(*number);
  return {};
}

Result<void> read_groups(const YamlNode& root, NeuroFuzzyRecipe& recipe) {
  const auto node = root.at("groups");
  if (!node.ok()) return node.error();
  CLEW_RETURN_IF_ERROR(node->check_keys({"train", "test"}));
  CLEW_RETURN_IF_ERROR(read_count(*node, "train", 1, recipe.train_groups));
  return read_count(*node, "test", 1, recipe.test_groups);
}

Result<void> read_rates(const YamlNode& root, NeuroFuzzyRecipe& recipe) {
  const auto node = root.at("learning_rates");
  if (!node.ok()) return node.error();
  CLEW_RETURN_IF_ERROR(node->check_keys({"centres", "widths", "outputs"}));
  CLEW_RETURN_IF_ERROR(read_number(*node, "centres", {0.0, 1e6}, recipe.rate_centres));
  CLEW_RETURN_IF_ERROR(read_number(*node, "widths", {0.0, 1e6}, recipe.rate_widths));
  return read_number(*node, "outputs", {0.0, 1.0}, recipe.rate_outputs);
}

Result<void> read_worlds(const YamlNode& root, std::vector<std::string>& worlds) {
  const auto node = root.at("worlds");
  if (!node.ok()) return node.error();
  const auto items = node->items();
  if (!items.ok()) return items.error();
  for (const YamlNode& item : *items) {
    const auto name = item.string();
    if (!name.ok()) return name.error();
    worlds.push_back(*name);
  }
  return worlds.empty() ? Result<void>(node->error("expected at least one world")) : Result<void>();
}

}  // namespace

Result<NeuroFuzzyRecipe> NeuroFuzzyRecipe::parse(const core::Resource& resource) {
  const auto root = YamlNode::parse(resource.text, resource.file);
  if (!root.ok()) return root.error();
  CLEW_RETURN_IF_ERROR(
      root->check_keys({"format", "seed", "start", "groups", "iterations", "tolerance_mps",
                        "learning_rates", "wheel_base_m", "places", "worlds"}));
  CLEW_RETURN_IF_ERROR(core::check_format(*root, "clew-neuro-fuzzy-training/1"));
  NeuroFuzzyRecipe recipe;
  CLEW_RETURN_IF_ERROR(read_count(*root, "seed", 0, recipe.seed));
  const auto start = root->at("start");
  if (!start.ok()) return start.error();
  const auto name = start->string();
  if (!name.ok()) return name.error();
  recipe.start = *name;
  CLEW_RETURN_IF_ERROR(read_groups(*root, recipe));
  CLEW_RETURN_IF_ERROR(read_count(*root, "iterations", 1, recipe.iterations));
  CLEW_RETURN_IF_ERROR(read_number(*root, "tolerance_mps", {0.0, 1.0}, recipe.tolerance_mps));
  CLEW_RETURN_IF_ERROR(read_rates(*root, recipe));
  CLEW_RETURN_IF_ERROR(read_number(*root, "wheel_base_m", {0.01, 5.0}, recipe.wheel_base_m));
  CLEW_RETURN_IF_ERROR(read_count(*root, "places", 1, recipe.places));
  CLEW_RETURN_IF_ERROR(read_worlds(*root, recipe.worlds));
  return recipe;
}

}  // namespace clew::control
