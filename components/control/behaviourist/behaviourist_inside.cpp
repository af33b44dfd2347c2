// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "control/behaviourist/fuzzy_behaviourist.hpp"
#include "core/angle.hpp"
#include "domain/words.hpp"

namespace clew::control {
namespace {

constexpr std::array<const char*, kStimulusCount> kStimuli = {
    "target_bearing_rad", "front_m", "left_m", "right_m", "left_minus_right_m"};
// Values along each axis of the control surface.
constexpr std::size_t kResponses = 21;
constexpr double kMostFront_m = 2.0;

/// How far a rule holds: the product of its conditions' degrees.
double strength_of(const BehaviouristRules& rules, const BehaviouristRules::Rule& rule,
                   const Stimuli& stimuli) {
  double degree = 1.0;
  for (const BehaviouristRules::Condition& condition : rule.conditions) {
    const auto stimulus = static_cast<std::size_t>(condition.stimulus);
    degree *= rules.sets[stimulus].degree(condition.set, stimuli[stimulus]);
  }
  return degree;
}

void tell_memberships(const BehaviouristRules& rules, const Stimuli& stimuli,
                      domain::Inside& inside) {
  for (std::size_t s = 0; s < kStimulusCount; ++s) {
    std::vector<double> degrees;
    for (std::size_t set = 0; set < rules.sets[s].peaks.size(); ++set) {
      degrees.push_back(rules.sets[s].degree(set, stimuli[s]));
    }
    domain::InsideGroup& item = inside.values.item("stimuli");
    item.text("stimulus", kStimuli[s]);
    item.number("value", stimuli[s]);
    item.list("set_peaks", rules.sets[s].peaks);
    item.list("memberships", std::move(degrees));
  }
}

}  // namespace

void FuzzyBehaviourist::tell(const domain::Odometry&, const domain::Scan&, const core::Vec2&,
                             domain::Inside& inside) const {
  tell_memberships(rules_, stimuli_, inside);
  std::size_t strongest = 0;
  std::size_t firing = 0;
  double most = -1.0;
  for (std::size_t i = 0; i < rules_.rules.size(); ++i) {
    const BehaviouristRules::Rule& rule = rules_.rules[i];
    const double strength = strength_of(rules_, rule, stimuli_);
    if (strength > 0.0) ++firing;
    if (strength > most) {
      most = strength;
      strongest = i;
    }
    domain::InsideGroup& item = inside.values.item("rules");
    item.number("rule", static_cast<double>(i + 1));
    item.number("strength", strength);
    item.number("weight", rule.weight);
    if (rule.turn_rate_radps) item.number("turn_rate", *rule.turn_rate_radps, "radps");
    if (rule.speed_mps) item.number("speed", *rule.speed_mps, "mps");
  }
  tell_surface(inside);
  inside.say("Ahead " + domain::say_metres(stimuli_[1]) + " are free, on the left " +
             domain::say_metres(stimuli_[2]) + ", on the right " + domain::say_metres(stimuli_[3]) +
             ". " + std::to_string(firing) + " of " +
             domain::say_count(rules_.rules.size(), "rule") + " hold, rule " +
             std::to_string(strongest + 1) + " most, to " + domain::say_percent(most) + ".");
}

/// The turn rate for any bearing of the target and any distance ahead, all else as it is.
void FuzzyBehaviourist::tell_surface(domain::Inside& inside) const {
  domain::InsideGrid surface{
      kResponses, {}, "target from 180 degrees left to 180 right", "front distance, 0 to 2 m", {}};
  constexpr auto kLast = static_cast<double>(kResponses - 1);
  for (std::size_t row = 0; row < kResponses; ++row) {
    for (std::size_t column = 0; column < kResponses; ++column) {
      Stimuli there = stimuli_;
      there[0] = core::kPi * (1.0 - 2.0 * static_cast<double>(column) / kLast);
      there[1] = kMostFront_m * static_cast<double>(row) / kLast;
      surface.values.push_back(rules_.respond(there).turn_rate_radps);
    }
  }
  const double column = 0.5 * (1.0 - stimuli_[0] / core::kPi) * kLast;
  const double row = std::clamp(stimuli_[1] / kMostFront_m, 0.0, 1.0) * kLast;
  surface.marked =
      static_cast<std::size_t>(row + 0.5) * kResponses + static_cast<std::size_t>(column + 0.5);
  inside.values.grid("turn_rate_surface", std::move(surface), "radps");
}

}  // namespace clew::control
