// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/following/wall_rules.hpp"

#include "core/yaml_fields.hpp"

namespace clew::recover {
namespace {

using core::Range;
using core::Result;
using core::YamlNode;

constexpr Range kRatio = {0.0, 1.0};
constexpr Range kTurn_deg = {-90.0, 90.0};
constexpr Range kStep_m = {0.0, 1.0};

}  // namespace

Result<WallRules> WallRules::parse(const core::Resource& resource) {
  const auto parsed = YamlNode::parse(resource.text, resource.file);
  if (!parsed.ok()) return parsed.error();
  const YamlNode& root = *parsed;
  CLEW_RETURN_IF_ERROR(
      root.check_keys({"format", "blocked_full_ratio", "blocked_none_ratio", "close_ratio",
                       "good_ratio", "far_ratio", "break_ratio", "blocked_turn_deg",
                       "close_turn_deg", "far_turn_deg", "blocked_step_m", "free_step_m"}));
  CLEW_RETURN_IF_ERROR(core::check_format(root, "clew-obstacle-following/1"));

  WallRules rules;
  CLEW_RETURN_IF_ERROR(read_number(root, "blocked_full_ratio", kRatio, rules.blocked_full_ratio));
  CLEW_RETURN_IF_ERROR(read_number(root, "blocked_none_ratio", kRatio, rules.blocked_none_ratio));
  CLEW_RETURN_IF_ERROR(read_number(root, "close_ratio", kRatio, rules.close_ratio));
  CLEW_RETURN_IF_ERROR(read_number(root, "good_ratio", kRatio, rules.good_ratio));
  CLEW_RETURN_IF_ERROR(read_number(root, "far_ratio", kRatio, rules.far_ratio));
  CLEW_RETURN_IF_ERROR(read_number(root, "break_ratio", kRatio, rules.break_ratio));
  if (rules.blocked_full_ratio >= rules.blocked_none_ratio) {
    return root.error("blocked_none_ratio must be more than blocked_full_ratio");
  }
  if (rules.close_ratio >= rules.good_ratio || rules.good_ratio >= rules.far_ratio ||
      rules.far_ratio > rules.break_ratio) {
    return root.error("close_ratio, good_ratio, far_ratio and break_ratio must rise");
  }
  CLEW_RETURN_IF_ERROR(read_angle(root, "blocked_turn_deg", kTurn_deg, rules.blocked_turn_rad));
  CLEW_RETURN_IF_ERROR(read_angle(root, "close_turn_deg", kTurn_deg, rules.close_turn_rad));
  CLEW_RETURN_IF_ERROR(read_angle(root, "far_turn_deg", kTurn_deg, rules.far_turn_rad));
  CLEW_RETURN_IF_ERROR(read_number(root, "blocked_step_m", kStep_m, rules.blocked_step_m));
  CLEW_RETURN_IF_ERROR(read_number(root, "free_step_m", kStep_m, rules.free_step_m));
  return rules;
}

}  // namespace clew::recover
