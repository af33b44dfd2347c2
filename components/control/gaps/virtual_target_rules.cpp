// SPDX-License-Identifier: Apache-2.0
#include "control/gaps/virtual_target_rules.hpp"

#include <string>
#include <vector>

#include "core/angle.hpp"
#include "core/nearest_name.hpp"
#include "core/yaml_fields.hpp"

namespace clew::control {
namespace {

using core::Range;
using core::Result;
using core::YamlNode;
using Words = std::vector<std::string>;

const Words kPositionWords = {"D", "U", "S"};
const Words kDistanceWords = {"VN", "N", "M", "F", "VF"};
const Words kTurnWords = {"Smooth", "Medium", "Large"};
const Words kSpeedWords = {"Slow", "Medium", "Fast"};

/// A map from each of these words to a number within the range.
Result<void> read_levels(const YamlNode& root, const char* key, const Words& words, Range range,
                         std::vector<double>& levels) {
  const auto map = root.at(key);
  if (!map.ok()) return map.error();
  CLEW_RETURN_IF_ERROR(map->check_keys(words));
  levels.resize(words.size());
  for (std::size_t i = 0; i < words.size(); ++i) {
    CLEW_RETURN_IF_ERROR(read_number(*map, words[i].c_str(), range, levels[i]));
  }
  return {};
}

/// The place of a rule's word in its table.
Result<std::size_t> read_word(const YamlNode& node, const char* what, const Words& words) {
  const auto word = node.string();
  if (!word.ok()) return word.error();
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == *word) return i;
  }
  return node.error(core::unknown_name(what, *word, words));
}

struct Rule {
  std::size_t position = 0;
  std::size_t distance = 0;
  std::size_t turn = 0;
  std::size_t speed = 0;
};

Result<Rule> read_rule(const YamlNode& node) {
  const auto words = node.items();
  if (!words.ok()) return words.error();
  if (words->size() != 4) {
    return node.error("found " + node.found() + ", expected [OP, OD, R_V, T_V]");
  }
  const auto position = read_word((*words)[0], "obstacle position", kPositionWords);
  if (!position.ok()) return position.error();
  const auto distance = read_word((*words)[1], "obstacle distance", kDistanceWords);
  if (!distance.ok()) return distance.error();
  const auto turn = read_word((*words)[2], "rotational velocity", kTurnWords);
  if (!turn.ok()) return turn.error();
  const auto speed = read_word((*words)[3], "translational velocity", kSpeedWords);
  if (!speed.ok()) return speed.error();
  return Rule{*position, *distance, *turn, *speed};
}

/// Every pair of sets has one rule.
Result<void> read_rules(const YamlNode& root, const std::vector<double>& turn_rates_radps,
                        const std::vector<double>& speeds_mps, VirtualTargetRules& rules) {
  const auto list = root.at("rules");
  if (!list.ok()) return list.error();
  const auto items = list->items();
  if (!items.ok()) return items.error();
  std::array<std::array<bool, VirtualTargetRules::kDistances>, VirtualTargetRules::kPositions>
      given{};
  for (const YamlNode& item : *items) {
    const auto rule = read_rule(item);
    if (!rule.ok()) return rule.error();
    bool& seen = given[rule->position][rule->distance];
    if (seen) {
      return item.error("a second rule for " + kPositionWords[rule->position] + " and " +
                        kDistanceWords[rule->distance]);
    }
    seen = true;
    rules.outputs[rule->position][rule->distance] = {turn_rates_radps[rule->turn],
                                                     speeds_mps[rule->speed]};
  }
  for (std::size_t i = 0; i < given.size(); ++i) {
    for (std::size_t j = 0; j < given[i].size(); ++j) {
      if (!given[i][j]) {
        return list->error("no rule for " + kPositionWords[i] + " and " + kDistanceWords[j]);
      }
    }
  }
  return {};
}

}  // namespace

VirtualTargetRules::Output VirtualTargetRules::infer(double obstacle_position_rad,
                                                     double obstacle_distance_m) const {
  Output sum;  // the degrees of all rules add up to 1
  for (std::size_t i = 0; i < kPositions; ++i) {
    const double position = position_rad.degree(i, obstacle_position_rad);
    for (std::size_t j = 0; j < kDistances; ++j) {
      const double degree = position * distance_m.degree(j, obstacle_distance_m);
      sum.turn_rate_radps += degree * outputs[i][j].turn_rate_radps;
      sum.speed_mps += degree * outputs[i][j].speed_mps;
    }
  }
  return sum;
}

Result<VirtualTargetRules> VirtualTargetRules::parse(const core::Resource& resource) {
  const auto parsed = YamlNode::parse(resource.text, resource.file);
  if (!parsed.ok()) return parsed.error();
  const YamlNode& root = *parsed;
  CLEW_RETURN_IF_ERROR(
      root.check_keys({"format", "obstacle_position_deg", "obstacle_distance_m",
                       "rotational_velocity_radps", "translational_velocity_mps", "rules"}));
  CLEW_RETURN_IF_ERROR(core::check_format(root, "clew-nakhaeinia-nvt/1"));
  VirtualTargetRules rules;
  CLEW_RETURN_IF_ERROR(read_levels(root, "obstacle_position_deg", kPositionWords, {0.0, 180.0},
                                   rules.position_rad.peaks));
  CLEW_RETURN_IF_ERROR(read_levels(root, "obstacle_distance_m", kDistanceWords, {0.0, 100.0},
                                   rules.distance_m.peaks));
  if (!rules.position_rad.rises() || !rules.distance_m.rises()) {
    return root.error("the peaks of obstacle_position_deg and obstacle_distance_m must rise");
  }
  for (double& peak : rules.position_rad.peaks) peak = core::radians(peak);
  std::vector<double> turn_rates_radps;
  std::vector<double> speeds_mps;
  CLEW_RETURN_IF_ERROR(
      read_levels(root, "rotational_velocity_radps", kTurnWords, {0.0, 20.0}, turn_rates_radps));
  CLEW_RETURN_IF_ERROR(
      read_levels(root, "translational_velocity_mps", kSpeedWords, {0.0, 10.0}, speeds_mps));
  CLEW_RETURN_IF_ERROR(read_rules(root, turn_rates_radps, speeds_mps, rules));
  return rules;
}

}  // namespace clew::control
