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
    TrainingGroup sum{first->readings, {}, {}};
    auto last = first;
    for (; last != groups.end() && last->readings == first->readings; ++last) {
      sum.wanted = sum.wanted + last->wanted;
      for (std::size_t k = 0; k < sum.parts_mps.size(); ++k) {
        sum.parts_mps[k] += last->parts_mps[k];
      }
    }
    const auto count = static_cast<double>(last - first);
    sum.wanted = {sum.wanted.left_mps / count, sum.wanted.right_mps / count};
    for (double& part_mps : sum.parts_mps) part_mps /= count;
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

/// Both wheels learn one group.
void learn_together(const NeuroFuzzyRecipe& recipe, const TrainingGroups& groups,
                    const core::Random& random, NeuroFuzzyNets& nets) {
  const double draw = random.uniform(0) * static_cast<double>(groups.train.size());
  const TrainingGroup& group = groups.train[static_cast<std::size_t>(draw)];
  learn_wheel(recipe, group.readings, group.wanted.left_mps, nets.nets[NeuroFuzzyNets::kLeft1],
              nets.nets[NeuroFuzzyNets::kLeft2]);
  learn_wheel(recipe, group.readings, group.wanted.right_mps, nets.nets[NeuroFuzzyNets::kRight1],
              nets.nets[NeuroFuzzyNets::kRight2]);
}

/// Each network learns one group of its own.
void learn_for_itself(const NeuroFuzzyRecipe& recipe, const TrainingGroups& groups,
                      const core::Random& random, NeuroFuzzyNets& nets) {
  for (std::size_t k = 0; k < NeuroFuzzyNets::kCount; ++k) {
    const auto& own = groups.of_network[k];
    const double draw =
        random.uniform(static_cast<std::uint32_t>(k)) * static_cast<double>(own.size());
    const TrainingGroup& group = own[static_cast<std::size_t>(draw)];
    const bool ahead_back = k == NeuroFuzzyNets::kLeft1 || k == NeuroFuzzyNets::kRight1;
    const double first = group.readings[ahead_back ? control::kAhead : control::kLeft];
    const double second = group.readings[ahead_back ? control::kBack : control::kRight];
    Net& net = nets.nets[k];
    learn(recipe, net.gradient(first, second), net.infer(first, second) - group.parts_mps[k], net);
  }
}

}  // namespace

core::Result<TrainingGroups> draw_groups(const NeuroFuzzyRecipe& recipe,
                                         std::vector<TrainingGroup> shown) {
  std::vector<TrainingGroup> pool = distinct(std::move(shown));
  const std::uint64_t common = recipe.train_groups + recipe.test_groups;
  const std::uint64_t own = recipe.each_network ? recipe.train_groups : 0;
  const std::uint64_t wanted = common + NeuroFuzzyNets::kCount * own;
  if (pool.size() < wanted) {
    return core::Error{"the runs show " + std::to_string(pool.size()) +
                       " different combinations of readings; the recipe needs " +
                       std::to_string(recipe.train_groups) + " groups to train and " +
                       std::to_string(recipe.test_groups) + " to test" +
                       (own > 0 ? ", and " + std::to_string(own) + " for each network" : "")};
  }
  const core::Random random({recipe.seed, 0, kRandomComponent, 0});
  for (std::size_t i = 0; i < wanted; ++i) {
    const double draw = random.uniform(static_cast<std::uint32_t>(i));
    std::swap(pool[i],
              pool[i + static_cast<std::size_t>(draw * static_cast<double>(pool.size() - i))]);
  }
  const auto train_end = pool.begin() + static_cast<std::ptrdiff_t>(recipe.train_groups);
  const auto test_end = pool.begin() + static_cast<std::ptrdiff_t>(common);
  TrainingGroups groups{{pool.begin(), train_end}, {train_end, test_end}, {}};
  auto begin = test_end;
  for (auto& of_network : groups.of_network) {
    const auto end = begin + static_cast<std::ptrdiff_t>(own);
    of_network.assign(begin, end);
    begin = end;
  }
  return groups;
}

NeuroFuzzyTraining train_neuro_fuzzy(const NeuroFuzzyRecipe& recipe, const NeuroFuzzyNets& start,
                                     const TrainingGroups& groups) {
  NeuroFuzzyTraining training{start, {}};
  const auto note = [&](std::uint64_t iteration) {
    const NeuroFuzzyNets told = training.nets.rounded();
    training.curve.push_back(
        {iteration, error_mps(told, groups.train), error_mps(told, groups.test)});
  };
  const std::uint64_t stride = std::max<std::uint64_t>(1, recipe.iterations / kCurvePoints);
  note(0);
  for (std::uint64_t n = 1; n <= recipe.iterations; ++n) {
    const core::Random random({recipe.seed, 0, kRandomComponent, n});
    if (recipe.each_network) {
      learn_for_itself(recipe, groups, random, training.nets);
    } else {
      learn_together(recipe, groups, random, training.nets);
    }
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

namespace {

/// What a recipe chooses of how training begins and goes on, where it is not the default.
std::string told_start(const NeuroFuzzyRecipe& recipe) {
  std::string text;
  if (recipe.sets == StartSets::kReadings) text += "  sets: readings\n";
  if (recipe.outputs == StartOutputs::kRandom) text += "  outputs: random\n";
  if (recipe.each_network) text += "  learn: networks\n";
  return text;
}

}  // namespace

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
             "{}"
             "  groups: {{train: {}, test: {}}}\n"
             "  iterations: {}\n"
             "{}"
             "  # Root mean squared errors over the test groups: before training, of tables of "
             "128\n"
             "  # rules with interpolated and with filled-in outputs, and of what follows.\n"
             "  test_errors_mps: {{rules: {:.5f}, rules_128_interpolated: {:.5f}, "
             "rules_128_filled: {:.5f}, trained: {:.5f}}}\n",
             command, recipe.seed, recipe.start, told_start(recipe), recipe.train_groups,
             recipe.test_groups, training.curve.back().iteration, origin, errors.rules_mps,
             errors.interpolated_mps, errors.filled_mps, errors.trained_mps) +
         training.nets.to_yaml();
}

}  // namespace clew::train
