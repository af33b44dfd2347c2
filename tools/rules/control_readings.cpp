// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "control/attraction/krishna_kalra_fuzzy.hpp"
#include "control/behaviourist/behaviourist_rules.hpp"
#include "control/gaps/virtual_target_rules.hpp"
#include "core/angle.hpp"
#include "core/yaml_reader.hpp"
#include "rules/readings.hpp"
#include "rules/sampling.hpp"

namespace clew::rules {
namespace {

using core::Result;

const std::vector<std::string> kPositions = {"dangerous", "uncertain", "safe"};
const std::vector<std::string> kDistances = {"very near", "near", "medium", "far", "very far"};

/// A scan of seven cones in which the left three and the right three have one reading each, as
/// shares of a range of 1 m, and the one ahead has the lesser.
domain::Scan sides(double left, double right) {
  domain::Scan scan;
  scan.range_max_m = 1.0;
  for (const double range : {left, left, left, std::min(left, right), right, right, right}) {
    scan.ranges_m.push_back(range);
  }
  return scan;
}

}  // namespace

Result<void> read_krishna_kalra(const core::Resource& file, RuleBase& base) {
  const auto rules = control::KrishnaKalraRules::parse(file);
  if (!rules.ok()) return rules.error();
  const control::KrishnaKalraFuzzy law({}, *rules);
  const Axis reading{"reading", "of the range", 0.0, 1.0};
  base.variables = {{reading,
                     {sample_set("near", reading, [&](double u) { return law.near(u); }),
                      sample_set("far", reading, [&](double u) { return 1.0 - law.near(u); })}}};
  for (std::size_t i = 0; i < rules->near_turns_rad.size(); ++i) {
    base.rules.push_back(fmt::format(
        "if reading {} of 7, from the left, is near, turn {:g} deg to the right; if far, {:g} deg",
        i + 1, core::degrees(rules->near_turns_rad[i]), core::degrees(rules->far_turns_rad[i])));
  }
  base.rules.push_back(fmt::format("if the target is to a side, turn there by {:g} deg at most",
                                   core::degrees(rules->target_turn_rad)));
  const auto motion = [&](double left, double right) {
    control::KrishnaKalraFuzzy fresh = law;
    return fresh.step({}, sides(left, right), {10.0, 0.0});
  };
  const Axis left{"left readings", "of the range", 0.0, 1.0};
  const Axis right{"right readings", "of the range", 0.0, 1.0};
  const std::string given = "the target is ahead and far";
  base.surfaces = {
      sample_surface({"turn to the left", "deg", given, left, right, 0, {}},
                     [&](double l, double r) { return core::degrees(motion(l, r).turn_rad); }),
      sample_surface({"step", "m", given, left, right, 0, {}},
                     [&](double l, double r) { return motion(l, r).step_m; })};
  return {};
}

Result<void> read_virtual_target(const core::Resource& file, RuleBase& base) {
  const auto rules = control::VirtualTargetRules::parse(file);
  if (!rules.ok()) return rules.error();
  const Axis position{"obstacle position", "deg", 0.0,
                      1.3 * core::degrees(rules->position_rad.peaks.back())};
  const Axis distance{"obstacle distance", "m", 0.0, 1.2 * rules->distance_m.peaks.back()};
  base.variables = {sample_partition(position, rules->position_rad, kPositions, core::radians(1.0)),
                    sample_partition(distance, rules->distance_m, kDistances, 1.0)};
  for (std::size_t p = 0; p < kPositions.size(); ++p) {
    for (std::size_t d = 0; d < kDistances.size(); ++d) {
      const auto& output = rules->outputs[p][d];
      base.rules.push_back(fmt::format(
          "if the obstacle is {} and {}, turn to the target at {:g} rad/s, drive at {:g} m/s",
          kPositions[p], kDistances[d], output.turn_rate_radps, output.speed_mps));
    }
  }
  base.surfaces = {
      sample_surface({"turn rate to the target", "rad/s", {}, position, distance, 0, {}},
                     [&](double p_deg, double d_m) {
                       return rules->infer(core::radians(p_deg), d_m).turn_rate_radps;
                     }),
      sample_surface({"speed", "m/s", {}, position, distance, 0, {}},
                     [&](double p_deg, double d_m) {
                       return rules->infer(core::radians(p_deg), d_m).speed_mps;
                     })};
  return {};
}

namespace {

using control::BehaviouristRules;
using control::kStimulusCount;

struct StimulusName {
  const char* key;  ///< in the file
  const char* name;
};
constexpr std::array<StimulusName, kStimulusCount> kStimuli = {
    {{"target_deg", "target bearing"},
     {"front_m", "distance ahead"},
     {"left_m", "distance on the left"},
     {"right_m", "distance on the right"},
     {"freer_m", "left less right"}}};
constexpr double kFree_m = 1.0;

/// The names of the sets of each stimulus, which rules do not need.
Result<std::array<std::vector<std::string>, kStimulusCount>> set_names(const core::Resource& file) {
  const auto root = core::YamlNode::parse(file.text, file.file);
  if (!root.ok()) return root.error();
  const auto sets = root->at("sets");
  if (!sets.ok()) return sets.error();
  std::array<std::vector<std::string>, kStimulusCount> names;
  for (std::size_t i = 0; i < kStimulusCount; ++i) {
    const auto node = sets->at(kStimuli[i].key);
    if (!node.ok()) return node.error();
    const auto entries = node->entries();
    if (!entries.ok()) return entries.error();
    for (const auto& entry : *entries) names[i].push_back(entry.key);
  }
  return names;
}

std::string sentence(const BehaviouristRules::Rule& rule,
                     const std::array<std::vector<std::string>, kStimulusCount>& names) {
  std::string text;
  for (const BehaviouristRules::Condition& condition : rule.conditions) {
    const auto stimulus = static_cast<std::size_t>(condition.stimulus);
    text += fmt::format("{}{} is {}", text.empty() ? "if " : " and ", kStimuli[stimulus].name,
                        names[stimulus][condition.set]);
  }
  if (rule.turn_rate_radps) text += fmt::format(", turn at {:g} rad/s", *rule.turn_rate_radps);
  if (rule.speed_mps) text += fmt::format(", drive at {:g} m/s", *rule.speed_mps);
  return text + (rule.weight == 1.0 ? "" : fmt::format(" (weight {:g})", rule.weight));
}

}  // namespace

Result<void> read_behaviourist(const core::Resource& file, RuleBase& base) {
  const auto rules = BehaviouristRules::parse(file);
  if (!rules.ok()) return rules.error();
  const auto names = set_names(file);
  if (!names.ok()) return names.error();
  const Axis target{kStimuli[0].name, "deg to the left", -180.0, 180.0};
  const Axis front{kStimuli[1].name, "m", 0.0, 1.5 * rules->sets[1].peaks.back()};
  base.variables = {sample_partition(target, rules->sets[0], (*names)[0], core::radians(1.0)),
                    sample_partition(front, rules->sets[1], (*names)[1], 1.0)};
  for (std::size_t i = 2; i < kStimulusCount; ++i) {
    const auto& peaks = rules->sets[i].peaks;
    const double margin = 0.5 * (peaks.back() - peaks.front());
    const double low = peaks.front() < 0.0 ? peaks.front() - margin : 0.0;
    base.variables.push_back(sample_partition({kStimuli[i].name, "m", low, peaks.back() + margin},
                                              rules->sets[i], (*names)[i], 1.0));
  }
  for (const auto& rule : rules->rules) base.rules.push_back(sentence(rule, *names));
  const auto respond = [&](double target_deg, double front_m) {
    return rules->respond({core::radians(target_deg), front_m, kFree_m, kFree_m, 0.0});
  };
  const std::string given = "1 m is free on both sides";
  base.surfaces = {
      sample_surface({"turn rate to the left", "rad/s", given, target, front, 0, {}},
                     [&](double t, double f) { return respond(t, f).turn_rate_radps; }),
      sample_surface({"speed", "m/s", given, target, front, 0, {}},
                     [&](double t, double f) { return respond(t, f).speed_mps; })};
  return {};
}

}  // namespace clew::rules
