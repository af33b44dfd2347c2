// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "core/angle.hpp"
#include "core/parameters.hpp"
#include "core/yaml_reader.hpp"
#include "recover/wall_follower.hpp"

namespace clew::recover {
namespace {

using core::Range;
using core::Result;
using core::YamlNode;

constexpr char kFormat[] = "clew-obstacle-following/1";
constexpr Range kRatio = {0.0, 1.0};
constexpr Range kTurnDeg = {-90.0, 90.0};
constexpr Range kStepM = {0.0, 1.0};

Result<void> read_number(const YamlNode& map, const char* key, Range range, double& field) {
  const auto node = map.at(key);
  if (!node.ok()) return node.error();
  const auto number = node->number();
  if (!number.ok()) return number.error();
  if (*number < range.min || *number > range.max) {
    return node->error("expected a number in [" + std::to_string(range.min) + ", " +
                       std::to_string(range.max) + "], found " + node->found());
  }
  field = *number;
  return {};
}

Result<void> check_format(const YamlNode& root) {
  const auto format = root.at("format");
  if (!format.ok()) return format.error();
  const auto name = format->string();
  if (name.ok() && *name == kFormat) return {};
  return format->error(std::string("expected ") + kFormat + ", found " + format->found());
}

}  // namespace

Result<WallRules> WallRules::parse(const core::Resource& resource) {
  const auto root = YamlNode::parse(resource.text, resource.file);
  if (!root.ok()) return root.error();
  CLEW_RETURN_IF_ERROR(
      root->check_keys({"format", "blocked_full_ratio", "blocked_none_ratio", "close_ratio",
                        "good_ratio", "far_ratio", "break_ratio", "blocked_turn_deg",
                        "close_turn_deg", "far_turn_deg", "blocked_step_m", "free_step_m"}));
  CLEW_RETURN_IF_ERROR(check_format(*root));

  WallRules rules;
  CLEW_RETURN_IF_ERROR(read_number(*root, "blocked_full_ratio", kRatio, rules.blocked_full_ratio));
  CLEW_RETURN_IF_ERROR(read_number(*root, "blocked_none_ratio", kRatio, rules.blocked_none_ratio));
  CLEW_RETURN_IF_ERROR(read_number(*root, "close_ratio", kRatio, rules.close_ratio));
  CLEW_RETURN_IF_ERROR(read_number(*root, "good_ratio", kRatio, rules.good_ratio));
  CLEW_RETURN_IF_ERROR(read_number(*root, "far_ratio", kRatio, rules.far_ratio));
  CLEW_RETURN_IF_ERROR(read_number(*root, "break_ratio", kRatio, rules.break_ratio));
  if (rules.blocked_full_ratio >= rules.blocked_none_ratio) {
    return root->error("blocked_none_ratio must be more than blocked_full_ratio");
  }
  if (rules.close_ratio >= rules.good_ratio || rules.good_ratio >= rules.far_ratio ||
      rules.far_ratio > rules.break_ratio) {
    return root->error("close_ratio, good_ratio, far_ratio and break_ratio must rise");
  }
  CLEW_RETURN_IF_ERROR(read_number(*root, "blocked_turn_deg", kTurnDeg, rules.blocked_turn_rad));
  CLEW_RETURN_IF_ERROR(read_number(*root, "close_turn_deg", kTurnDeg, rules.close_turn_rad));
  CLEW_RETURN_IF_ERROR(read_number(*root, "far_turn_deg", kTurnDeg, rules.far_turn_rad));
  for (double* turn : {&rules.blocked_turn_rad, &rules.close_turn_rad, &rules.far_turn_rad}) {
    *turn = core::radians(*turn);
  }
  CLEW_RETURN_IF_ERROR(read_number(*root, "blocked_step_m", kStepM, rules.blocked_step_m));
  CLEW_RETURN_IF_ERROR(read_number(*root, "free_step_m", kStepM, rules.free_step_m));
  return rules;
}

}  // namespace clew::recover
