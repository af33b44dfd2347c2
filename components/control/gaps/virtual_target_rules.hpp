// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "core/fuzzy.hpp"
#include "core/resources.hpp"
#include "core/result.hpp"

namespace clew::control {

/// The fuzzy controller of Nakhaeinia et al. 2015, section II.A: two inputs, two outputs, and the
/// 15 rules of Table 1, as its rule base file gives them.
///
///     OP  obstacle position: D dangerous, U uncertain, S safe
///     OD  obstacle distance: VN, N, M, F, VF
///     R_V rotational velocity: Smooth, Medium, Large;   T_V translational: Slow, Medium, Fast
///
/// Degrees of a rule's two sets are multiplied; the output is the mean of the rules' consequents,
/// weighted by their degrees (product, centre of area of singletons). *Our reading:* the paper
/// gives the rules, and neither sets, nor consequents, nor the inference.
struct VirtualTargetRules {
  static constexpr std::size_t kPositions = 3;
  static constexpr std::size_t kDistances = 5;

  struct Output {
    double turn_rate_radps = 0.0;  ///< R_V, without its sign
    double speed_mps = 0.0;        ///< T_V
  };

  core::FuzzyPartition position_rad;  ///< D, U, S
  core::FuzzyPartition distance_m;    ///< VN, N, M, F, VF
  std::array<std::array<Output, kDistances>, kPositions> outputs{};

  /// R_V and T_V for an obstacle at this angle from the way, and this far.
  Output infer(double obstacle_position_rad, double obstacle_distance_m) const;

  /// Reads a rule base file. Refused: another format, keys that are unknown or missing, words that
  /// are none of a table's, numbers out of range, peaks that do not rise, a pair of sets with no
  /// rule or with two.
  static core::Result<VirtualTargetRules> parse(const core::Resource& resource);
};

}  // namespace clew::control
