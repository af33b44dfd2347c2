// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "control/infrared/neuro_fuzzy_nets.hpp"
#include "core/resources.hpp"
#include "core/result.hpp"

namespace clew::train {

using control::InfraredReadings;
using control::NeuroFuzzyNets;
using control::WheelSpeeds;

/// Where the Gaussian sets lie when training begins.
enum class StartSets : std::uint8_t {
  kRules,    ///< where those of the rule base lie
  kReadings  ///< evenly over what each sensor read in the training groups
};

/// What the rules say when training begins.
enum class StartOutputs : std::uint8_t {
  kRules,  ///< what those of the rule base say
  kRandom  ///< speeds drawn from 0 to 1 m/s: *set w_ij from 0 to 1 randomly*
};

/// How the networks are trained: a recipe file.
struct NeuroFuzzyRecipe {
  std::uint64_t seed = 1;
  std::string start;  ///< rule base whose networks training begins with
  StartSets sets = StartSets::kRules;
  StartOutputs outputs = StartOutputs::kRules;
  /// Each network learns its own sub-velocity from as many groups of its own, as in the paper;
  /// else the two of a wheel learn its speed together.
  bool each_network = false;
  std::uint64_t train_groups = 0;
  std::uint64_t test_groups = 0;
  std::uint64_t iterations = 0;     ///< t of the paper: each learns one group
  double tolerance_mps = 0.0;       ///< epsilon: stops where the training error falls below
  double rate_centres = 0.0;        ///< eta_a
  double rate_widths = 0.0;         ///< eta_sigma
  double rate_outputs = 0.0;        ///< eta_w
  double wheel_base_m = 0.0;        ///< for recorded commands that are no wheel speeds
  std::uint64_t places = 0;         ///< in each world, at which the expert is asked
  std::vector<std::string> worlds;  ///< where; unused with a recording, as places

  /// Reads a recipe. Refused: another format, keys that are unknown or missing, numbers out of
  /// range, no world.
  static core::Result<NeuroFuzzyRecipe> parse(const core::Resource& resource);
};

/// What the paper calls a group of data: readings, and the wheel speeds wanted for them.
struct TrainingGroup {
  InfraredReadings readings{};
  WheelSpeeds wanted;
  std::array<double, NeuroFuzzyNets::kCount> parts_mps{};  ///< of `wanted`, of the expert's only
};

struct TrainingGroups {
  std::vector<TrainingGroup> train;
  std::vector<TrainingGroup> test;
  /// The training groups of each network, if it learns for itself; none of them is in `test`.
  std::array<std::vector<TrainingGroup>, NeuroFuzzyNets::kCount> of_network{};
};

/// Draws the recipe's groups at random from what runs showed, each combination of readings at most
/// once; what was wanted for equal readings is averaged. An error if there are too few. Where each
/// network learns for itself, so many more are drawn for each of the four.
core::Result<TrainingGroups> draw_groups(const NeuroFuzzyRecipe& recipe,
                                         std::vector<TrainingGroup> shown);

/// The root of the mean squared error of both wheels' speeds over the groups, m/s.
template <typename Nets>
double error_mps(const Nets& nets, const std::vector<TrainingGroup>& groups) {
  double sum = 0.0;
  for (const TrainingGroup& group : groups) {
    const WheelSpeeds speeds = nets.speeds(group.readings);
    const double left = speeds.left_mps - group.wanted.left_mps;
    const double right = speeds.right_mps - group.wanted.right_mps;
    sum += left * left + right * right;
  }
  return std::sqrt(sum / (2.0 * static_cast<double>(groups.size())));
}

/// Errors after some iterations.
struct LearningPoint {
  std::uint64_t iteration = 0;
  double train_mps = 0.0;
  double test_mps = 0.0;
};

struct NeuroFuzzyTraining {
  NeuroFuzzyNets nets;               ///< as a file tells them
  std::vector<LearningPoint> curve;  ///< from iteration 0 to the last
};

/// Trains the networks: Wang, Yang & Meng, eqs 7 to 16. In each iteration one training group is
/// drawn at random, and for both wheels, with Delta V = V_1 + V_2 - V_T,
///
///     z <- z - eta_z Delta V dV/dz        for every parameter z of the wheel's two networks.
///
/// *Deviations:* the paper trains each network for itself on a sub-velocity that its expert gives,
/// as each_network does; a recording tells only what a wheel does, so by default the two networks
/// of a wheel learn its speed together. The rules of a network that ignores its second sensor
/// (Table I) go on ignoring it: the outputs of a row are learned as one. Widths and centres stay
/// within NeuroFuzzyNets::kWidths and kCentres.
NeuroFuzzyTraining train_neuro_fuzzy(const NeuroFuzzyRecipe& recipe, const NeuroFuzzyNets& start,
                                     const TrainingGroups& groups);

/// Root mean squared errors over the test groups, m/s, of what training is measured against.
struct TestErrors {
  double rules_mps = 0.0;         ///< the networks that training begins with
  double interpolated_mps = 0.0;  ///< LargerTable::interpolated
  double filled_mps = 0.0;        ///< LargerTable::filled
  double trained_mps = 0.0;
};

TestErrors compare(const NeuroFuzzyTraining& training, const NeuroFuzzyNets& start,
                   const TrainingGroups& groups);

/// The trained file: the same bytes for the same training. `command` is what a person types to get
/// it; `origin` are lines of YAML under trained_by that tell where the groups come from.
std::string trained_file(const NeuroFuzzyRecipe& recipe, const NeuroFuzzyTraining& training,
                         const TestErrors& errors, const std::string& command,
                         const std::string& origin);

}  // namespace clew::train
