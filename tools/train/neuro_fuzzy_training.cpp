// SPDX-License-Identifier: Apache-2.0
#include "train/neuro_fuzzy_training.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/random.hpp"
#include "train/larger_table.hpp"

namespace clew::train {
namespace {

using Net = NeuroFuzzyNets::Net;

constexpr std::uint32_t kRandomComponent = 101;  // apart from those of the stages
constexpr std::uint64_t kCurvePoints = 150;

/// Each combination of readings once, in the order of the readings.
std::vector<TrainingGroup> distinct(std::vector<TrainingGroup> groups) {
  std::stable_sort(groups.begin(), groups.end(),
                   [](const auto& a, const auto& b) { return a.readings < b.readings; });
  std::vector<TrainingGroup> merged;
  for (auto first = groups.begin(); first != groups.end();) {
    TrainingGroup sum{first->readings, {}};
    auto last = first;
    for (; last != groups.end() && last->readings == first->readings; ++last) {
      sum.wanted = sum.wanted + last->wanted;
    }
    const auto count = static_cast<double>(last - first);
    sum.wanted = {sum.wanted.left_mps / count, sum.wanted.right_mps / count};
    merged.push_back(sum);
    first = last;
  }
  return merged;
}

/// One step against the gradient of E = Delta V^2 / 2.
void learn(const NeuroFuzzyRecipe& recipe, const Net::Gradient& gradient, double delta_v_mps,
           Net& net) {
  const bool as_one = net.ignores_second();
  for (std::size_t i = 0; i < NeuroFuzzyNets::kSets; ++i) {
    for (std::size_t input = 0; input < 2; ++input) {
      double& centre = net.centres[input][i];
      double& width = net.widths[input][i];
      centre -= recipe.rate_centres * delta_v_mps * gradient.centres[input][i];
      width -= recipe.rate_widths * delta_v_mps * gradient.widths[input][i];
      centre = std::clamp(centre, NeuroFuzzyNets::kCentres.min, NeuroFuzzyNets::kCentres.max);
      width = std::clamp(width, NeuroFuzzyNets::kWidths.min, NeuroFuzzyNets::kWidths.max);
    }
    double row = 0.0;  // dV/dw of outputs that are one: the sum of theirs
    for (const double slope : gradient.outputs[i]) row += slope;
    for (std::size_t j = 0; j < NeuroFuzzyNets::kSets; ++j) {
      double& output = net.outputs[i][j];
      output -= recipe.rate_outputs * delta_v_mps * (as_one ? row : gradient.outputs[i][j]);
      output =
          std::clamp(output, NeuroFuzzyNets::kOutputs_mps.min, NeuroFuzzyNets::kOutputs_mps.max);
    }
  }
}

/// A wheel's two networks learn one group.
void learn_wheel(const NeuroFuzzyRecipe& recipe, const InfraredReadings& readings,
                 double wanted_mps, Net& ahead_back, Net& left_right) {
  const double v_mps = ahead_back.infer(readings[control::kAhead], readings[control::kBack]) +
                       left_right.infer(readings[control::kLeft], readings[control::kRight]);
  const double delta_v_mps = v_mps - wanted_mps;
  learn(recipe, ahead_back.gradient(readings[control::kAhead], readings[control::kBack]),
        delta_v_mps, ahead_back);
  learn(recipe, left_right.gradient(readings[control::kLeft], readings[control::kRight]),
        delta_v_mps, left_right);
}

}  // namespace

core::Result<TrainingGroups> draw_groups(const NeuroFuzzyRecipe& recipe,
                                         std::vector<TrainingGroup> shown) {
  std::vector<TrainingGroup> pool = distinct(std::move(shown));
  const std::uint64_t wanted = recipe.train_groups + recipe.test_groups;
  if (pool.size() < wanted) {
    return core::Error{"the runs show " + std::to_string(pool.size()) +
                       " different combinations of readings; the recipe needs " +
                       std::to_string(recipe.train_groups) + " groups to train and " +
                       std::to_string(recipe.test_groups) + " to test"};
  }
  const core::Random random({recipe.seed, 0, kRandomComponent, 0});
  for (std::size_t i = 0; i < wanted; ++i) {
    const double draw = random.uniform(static_cast<std::uint32_t>(i));
    std::swap(pool[i],
              pool[i + static_cast<std::size_t>(draw * static_cast<double>(pool.size() - i))]);
  }
  const auto train_end = pool.begin() + static_cast<std::ptrdiff_t>(recipe.train_groups);
  const auto test_end = pool.begin() + static_cast<std::ptrdiff_t>(wanted);
  return TrainingGroups{{pool.begin(), train_end}, {train_end, test_end}};
}

NeuroFuzzyTraining train_neuro_fuzzy(const NeuroFuzzyRecipe& recipe, const NeuroFuzzyNets& start,
                                     const TrainingGroups& groups) {
  NeuroFuzzyTraining training{start, {}};
  auto& nets = training.nets.nets;
  const auto note = [&](std::uint64_t iteration) {
    const NeuroFuzzyNets told = training.nets.rounded();
    training.curve.push_back(
        {iteration, error_mps(told, groups.train), error_mps(told, groups.test)});
  };
  const std::uint64_t stride = std::max<std::uint64_t>(1, recipe.iterations / kCurvePoints);
  note(0);
  for (std::uint64_t n = 1; n <= recipe.iterations; ++n) {
    const core::Random random({recipe.seed, 0, kRandomComponent, n});
    const double draw = random.uniform(0) * static_cast<double>(groups.train.size());
    const TrainingGroup& group = groups.train[static_cast<std::size_t>(draw)];
    learn_wheel(recipe, group.readings, group.wanted.left_mps, nets[NeuroFuzzyNets::kLeft1],
                nets[NeuroFuzzyNets::kLeft2]);
    learn_wheel(recipe, group.readings, group.wanted.right_mps, nets[NeuroFuzzyNets::kRight1],
                nets[NeuroFuzzyNets::kRight2]);
    if (n % stride != 0 && n != recipe.iterations) continue;
    note(n);
    if (training.curve.back().train_mps < recipe.tolerance_mps) break;
  }
  training.nets = training.nets.rounded();
  return training;
}

TestErrors compare(const NeuroFuzzyTraining& training, const NeuroFuzzyNets& start,
                   const TrainingGroups& groups) {
  return {error_mps(start, groups.test), error_mps(LargerTable::interpolated(start), groups.test),
          error_mps(LargerTable::filled(start, groups.train), groups.test),
          error_mps(training.nets, groups.test)};
}

std::string trained_file(const NeuroFuzzyRecipe& recipe, const NeuroFuzzyTraining& training,
                         const TestErrors& errors, const std::string& command,
                         const std::string& origin) {
  return fmt::format(
             "# SPDX-License-Identifier: Apache-2.0\n"
             "# Neuro-fuzzy controller of Wang, Yang & Meng, section III, trained: centres and "
             "widths "
             "of the\n# Gaussian sets in readings, a row a sensor; outputs in m/s, a row a set of "
             "the "
             "first sensor.\n# Made by the command below; do not edit.\n"
             "format: clew-neuro-fuzzy-trained/1\n"
             "trained_by:\n"
             "  command: \"{}\"\n"
             "  seed: {}\n"
             "  start: {}\n"
             "  groups: {{train: {}, test: {}}}\n"
             "  iterations: {}\n"
             "{}"
             "  # Root mean squared errors over the test groups: before training, of tables of "
             "128\n"
             "  # rules with interpolated and with filled-in outputs, and of what follows.\n"
             "  test_errors_mps: {{rules: {:.5f}, rules_128_interpolated: {:.5f}, "
             "rules_128_filled: {:.5f}, trained: {:.5f}}}\n",
             command, recipe.seed, recipe.start, recipe.train_groups, recipe.test_groups,
             training.curve.back().iteration, origin, errors.rules_mps, errors.interpolated_mps,
             errors.filled_mps, errors.trained_mps) +
         training.nets.to_yaml();
}

}  // namespace clew::train
