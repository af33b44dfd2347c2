// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/fuzzy.hpp"
#include "core/resources.hpp"
#include "core/result.hpp"

namespace clew::control {

/// What the elemental rules of a fuzzy behaviourist controller look at.
enum class Stimulus : std::uint8_t { kTarget, kFront, kLeft, kRight, kFreer };
inline constexpr std::size_t kStimulusCount = 5;

/// One value a stimulus: bearing in radians, distances from the skin in metres; kFreer is the
/// distance on the left less that on the right.
using Stimuli = std::array<double, kStimulusCount>;

/// The superposed elemental rules of a fuzzy behaviourist controller, from its rule base file.
///
/// A rule holds to the product of the degrees of its conditions. An output is the centre of area of
/// all rules that speak of it, singletons weighted by their areas:
///
///     y = sum_r w_r d_r c_r / sum_r w_r d_r                      0 where none speaks.
struct BehaviouristRules {
  struct Condition {
    Stimulus stimulus = Stimulus::kTarget;
    std::size_t set = 0;
  };
  struct Rule {
    std::vector<Condition> conditions;
    double weight = 1.0;  ///< the area of its consequents
    std::optional<double> turn_rate_radps;
    std::optional<double> speed_mps;
  };
  struct Response {
    double turn_rate_radps = 0.0;
    double speed_mps = 0.0;
  };

  std::array<core::FuzzyPartition, kStimulusCount> sets;
  std::vector<Rule> rules;

  Response respond(const Stimuli& stimuli) const;

  /// Reads a rule base file. Refused: another format, keys that are unknown or missing, fewer than
  /// two sets, peaks that do not rise, rules without conditions or consequents, sets that do not
  /// exist, numbers out of range.
  static core::Result<BehaviouristRules> parse(const core::Resource& resource);
};

}  // namespace clew::control
