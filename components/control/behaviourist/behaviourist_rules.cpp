// SPDX-License-Identifier: Apache-2.0
#include "control/behaviourist/behaviourist_rules.hpp"

#include <algorithm>
#include <string>

#include "core/angle.hpp"
#include "core/nearest_name.hpp"
#include "core/yaml_fields.hpp"

namespace clew::control {
namespace {

using core::Range;
using core::Result;
using core::YamlNode;
using Words = std::vector<std::string>;
using SetNames = std::array<Words, kStimulusCount>;

const Words kStimulusWords = {"target_deg", "front_m", "left_m", "right_m", "freer_m"};
constexpr Range kBearing_deg = {-180.0, 180.0};
constexpr Range kDistance_m = {-100.0, 100.0};

Result<void> read_sets(const YamlNode& root, BehaviouristRules& rules, SetNames& names) {
  const auto map = root.at("sets");
  if (!map.ok()) return map.error();
  CLEW_RETURN_IF_ERROR(map->check_keys(kStimulusWords));
  for (std::size_t i = 0; i < kStimulusCount; ++i) {
    const auto node = map->at(kStimulusWords[i]);
    if (!node.ok()) return node.error();
    const auto entries = node->entries();
    if (!entries.ok()) return entries.error();
    const bool is_angle = i == static_cast<std::size_t>(Stimulus::kTarget);
    for (const YamlNode::Entry& entry : *entries) {
      double peak = 0.0;
      CLEW_RETURN_IF_ERROR(
          read_number(*node, entry.key.c_str(), is_angle ? kBearing_deg : kDistance_m, peak));
      names[i].push_back(entry.key);
      rules.sets[i].peaks.push_back(is_angle ? core::radians(peak) : peak);
    }
    if (names[i].size() < 2 || !rules.sets[i].rises()) {
      return node->error(kStimulusWords[i] + " needs two sets or more, with peaks that rise");
    }
  }
  return {};
}

Result<std::size_t> read_word(const std::string& word, const YamlNode& where, const char* what,
                              const Words& words) {
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) return where.error(core::unknown_name(what, word, words));
  return static_cast<std::size_t>(found - words.begin());
}

Result<void> read_conditions(const YamlNode& rule_node, const SetNames& names,
                             BehaviouristRules::Rule& rule) {
  const auto node = rule_node.at("if");
  if (!node.ok()) return node.error();
  const auto entries = node->entries();
  if (!entries.ok()) return entries.error();
  for (const YamlNode::Entry& entry : *entries) {
    const auto stimulus = read_word(entry.key, entry.key_node, "stimulus", kStimulusWords);
    if (!stimulus.ok()) return stimulus.error();
    const auto word = entry.value.string();
    if (!word.ok()) return word.error();
    const auto set = read_word(*word, entry.value, "set", names[*stimulus]);
    if (!set.ok()) return set.error();
    rule.conditions.push_back({static_cast<Stimulus>(*stimulus), *set});
  }
  if (rule.conditions.empty()) return node->error("a rule needs a condition");
  return {};
}

Result<void> read_consequent(const YamlNode& node, const char* key, Range range,
                             std::optional<double>& consequent) {
  if (!node.find(key)) return {};
  double value = 0.0;
  CLEW_RETURN_IF_ERROR(read_number(node, key, range, value));
  consequent = value;
  return {};
}

Result<BehaviouristRules::Rule> read_rule(const YamlNode& node, const SetNames& names) {
  BehaviouristRules::Rule rule;
  CLEW_RETURN_IF_ERROR(node.check_keys({"if", "turn_rate_radps", "speed_mps", "weight"}));
  CLEW_RETURN_IF_ERROR(read_conditions(node, names, rule));
  CLEW_RETURN_IF_ERROR(
      read_consequent(node, "turn_rate_radps", {-20.0, 20.0}, rule.turn_rate_radps));
  CLEW_RETURN_IF_ERROR(read_consequent(node, "speed_mps", {0.0, 10.0}, rule.speed_mps));
  if (!rule.turn_rate_radps && !rule.speed_mps) {
    return node.error("a rule needs turn_rate_radps or speed_mps");
  }
  if (node.find("weight")) {
    CLEW_RETURN_IF_ERROR(read_number(node, "weight", {0.001, 1000.0}, rule.weight));
  }
  return rule;
}

/// A centre of area that is summed up.
struct Centre {
  double moment = 0.0;
  double area = 0.0;

  void add(const std::optional<double>& consequent, double area_of_rule) {
    if (!consequent) return;
    moment += area_of_rule * *consequent;
    area += area_of_rule;
  }
  double value() const { return area > 0.0 ? moment / area : 0.0; }
};

}  // namespace

BehaviouristRules::Response BehaviouristRules::respond(const Stimuli& stimuli) const {
  Centre turn_rate_radps;
  Centre speed_mps;
  for (const Rule& rule : rules) {
    double area = rule.weight;
    for (const Condition& condition : rule.conditions) {
      const auto stimulus = static_cast<std::size_t>(condition.stimulus);
      area *= sets[stimulus].degree(condition.set, stimuli[stimulus]);
    }
    turn_rate_radps.add(rule.turn_rate_radps, area);
    speed_mps.add(rule.speed_mps, area);
  }
  return {turn_rate_radps.value(), speed_mps.value()};
}

Result<BehaviouristRules> BehaviouristRules::parse(const core::Resource& resource) {
  const auto parsed = YamlNode::parse(resource.text, resource.file);
  if (!parsed.ok()) return parsed.error();
  const YamlNode& root = *parsed;
  CLEW_RETURN_IF_ERROR(root.check_keys({"format", "sets", "rules"}));
  CLEW_RETURN_IF_ERROR(core::check_format(root, "clew-fuzzy-behaviourist/1"));
  BehaviouristRules rules;
  SetNames names;
  CLEW_RETURN_IF_ERROR(read_sets(root, rules, names));
  const auto list = root.at("rules");
  if (!list.ok()) return list.error();
  const auto items = list->items();
  if (!items.ok()) return items.error();
  for (const YamlNode& item : *items) {
    auto rule = read_rule(item, names);
    if (!rule.ok()) return rule.error();
    rules.rules.push_back(std::move(rule).value());
  }
  return rules;
}

}  // namespace clew::control
