// SPDX-License-Identifier: Apache-2.0
#include "control/attraction/krishna_kalra_rules.hpp"

#include "core/angle.hpp"
#include "core/yaml_fields.hpp"

namespace clew::control {
namespace {

using core::Range;
using core::Result;
using core::YamlNode;

constexpr Range kRatio = {0.0, 1.0};
constexpr Range kTurn_deg = {-180.0, 180.0};
constexpr Range kStep_m = {0.0, 1.0};

Result<void> read_turns(const YamlNode& map, const char* key,
                        std::array<double, KrishnaKalraRules::kSensors>& turns_rad) {
  const auto node = map.at(key);
  if (!node.ok()) return node.error();
  const auto numbers = node->numbers(turns_rad.size(), "seven angles, leftmost sensor first");
  if (!numbers.ok()) return numbers.error();
  for (std::size_t i = 0; i < turns_rad.size(); ++i) {
    CLEW_RETURN_IF_ERROR(core::check_range(*node, (*numbers)[i], kTurn_deg));
    turns_rad[i] = core::radians((*numbers)[i]);
  }
  return {};
}

}  // namespace

Result<KrishnaKalraRules> KrishnaKalraRules::parse(const core::Resource& resource) {
  const auto parsed = YamlNode::parse(resource.text, resource.file);
  if (!parsed.ok()) return parsed.error();
  const YamlNode& root = *parsed;
  CLEW_RETURN_IF_ERROR(
      root.check_keys({"format", "near_full_ratio", "near_none_ratio", "target_turn_deg",
                       "near_turns_deg", "far_turns_deg", "target_near_step_m", "target_far_step_m",
                       "obstacle_near_step_m", "obstacle_far_step_m"}));
  CLEW_RETURN_IF_ERROR(core::check_format(root, "clew-krishna-kalra-control/1"));

  KrishnaKalraRules rules;
  CLEW_RETURN_IF_ERROR(read_number(root, "near_full_ratio", kRatio, rules.near_full_ratio));
  CLEW_RETURN_IF_ERROR(read_number(root, "near_none_ratio", kRatio, rules.near_none_ratio));
  if (rules.near_full_ratio >= rules.near_none_ratio) {
    return root.error("near_none_ratio must be more than near_full_ratio");
  }
  CLEW_RETURN_IF_ERROR(read_angle(root, "target_turn_deg", {0.0, 180.0}, rules.target_turn_rad));
  CLEW_RETURN_IF_ERROR(read_turns(root, "near_turns_deg", rules.near_turns_rad));
  CLEW_RETURN_IF_ERROR(read_turns(root, "far_turns_deg", rules.far_turns_rad));
  CLEW_RETURN_IF_ERROR(read_number(root, "target_near_step_m", kStep_m, rules.target_near_step_m));
  CLEW_RETURN_IF_ERROR(read_number(root, "target_far_step_m", kStep_m, rules.target_far_step_m));
  CLEW_RETURN_IF_ERROR(
      read_number(root, "obstacle_near_step_m", kStep_m, rules.obstacle_near_step_m));
  CLEW_RETURN_IF_ERROR(
      read_number(root, "obstacle_far_step_m", kStep_m, rules.obstacle_far_step_m));
  return rules;
}

}  // namespace clew::control
