// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "train/neuro_fuzzy_training.hpp"

namespace clew::train {

/// What training is measured against: rule tables four times as large, of eight sets a sensor and
/// so 128 rules, without any tuning of sets.
class LargerTable {
 public:
  static constexpr std::size_t kSets = 8;
  using Net = control::GaussianNet<kSets>;

  /// The opinion of the 32 rules on a finer grid: sets evenly from the first centre of `rules` to
  /// the last, of a width at which neighbours meet at a half, and outputs interpolated.
  static LargerTable interpolated(const NeuroFuzzyNets& rules);

  /// The same, filled from training groups: an output is the mean of the speeds wanted, each
  /// weighted by how much its rule holds, and of what the wheel's other table leaves over. A rule
  /// that holds nowhere keeps its opinion.
  static LargerTable filled(const NeuroFuzzyNets& rules, const std::vector<TrainingGroup>& groups);

  WheelSpeeds speeds(const InfraredReadings& readings) const;

 private:
  double output(std::size_t net, const InfraredReadings& readings) const;
  void fill(std::size_t net, std::size_t other, const std::vector<TrainingGroup>& groups);

  std::array<Net, NeuroFuzzyNets::kCount> nets_{};  ///< by NeuroFuzzyNets::Place
};

}  // namespace clew::train
