// SPDX-License-Identifier: Apache-2.0
#include "train/som_training.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "classify/spatial_classes.hpp"
#include "core/math.hpp"
#include "core/random.hpp"

namespace clew::train {
namespace {

using classify::ClassSequence;
using classify::reaches;
using classify::Som;
using classify::Triple;

constexpr double kToleranceClasses = 0.5;
constexpr std::uint8_t kFree = 8;
constexpr std::uint32_t kSomRandomComponent = 100;  // apart from those of the stages

using Sighting = std::pair<Triple, RunLengths>;

/// A landmark is something that is seen, and that leads from one place to another.
bool is_landmark(const Triple& classes) {
  return classes[0] != kFree && classes[1] != kFree && classes[0] != classes[2];
}

Triple mirrored(const Triple& classes) {
  return {train::mirrored(classes[0]), train::mirrored(classes[1]), train::mirrored(classes[2])};
}

/// The landmark vectors of a run and their mirror images, each with its lengths when it is
/// complete.
std::vector<Sighting> sightings(const ClassesSeen& classes_seen, const RunLengths& least_runs) {
  std::vector<Sighting> found;
  ClassSequence sequence(true);
  bool taken = false;
  for (const std::uint8_t spatial_class : classes_seen) {
    if (sequence.add(spatial_class)) taken = false;
    if (taken || !sequence.complete() || !reaches(sequence.lengths(), least_runs)) continue;
    taken = true;
    if (!is_landmark(sequence.classes())) continue;
    found.emplace_back(sequence.classes(), sequence.lengths());
    found.emplace_back(mirrored(sequence.classes()), sequence.lengths());
  }
  return found;
}

/// Every landmark once, in a fixed order.
std::vector<Triple> landmarks(const SomRecipe& recipe, const std::vector<ClassesSeen>& runs) {
  std::set<Triple> all;
  for (const ClassesSeen& run : runs) {
    for (const Sighting& sighting : sightings(run, recipe.least_runs)) all.insert(sighting.first);
  }
  return {all.begin(), all.end()};
}

/// A value that falls geometrically from first to last; progress 0..1.
double annealed(const std::array<double, 2>& range, double progress) {
  return range[0] * core::exp(progress * core::log(range[1] / range[0]));
}

/// Moves the winner's neighbourhood toward a vector. Appendix A.
void learn(Som::Lattice& lattice, const Triple& classes, double eta, double sigma) {
  const std::uint32_t winner = Som(lattice).recall(classes).neuron;
  const auto row = [](std::size_t i) { return static_cast<double>(i / Som::kColumns); };
  const auto column = [](std::size_t i) { return static_cast<double>(i % Som::kColumns); };
  for (std::size_t i = 0; i < Som::kNeurons; ++i) {
    const double rows = row(i) - row(winner);
    const double columns = column(i) - column(winner);
    const double h = core::exp(-(rows * rows + columns * columns) / (2.0 * sigma * sigma));
    for (std::size_t k = 0; k < 3; ++k) {
      double& weight = lattice[i].weights[k];
      weight += eta * h * (static_cast<double>(classes[k]) - weight);
    }
  }
}

Som::Lattice train(const SomRecipe& recipe, const std::vector<Triple>& inputs) {
  Som::Lattice lattice;
  const core::Random initial({recipe.seed, 0, kSomRandomComponent, 0});
  std::uint32_t index = 0;
  for (Som::Neuron& neuron : lattice) {
    for (double& weight : neuron.weights) weight = 8.0 * initial.uniform(index++);
  }
  for (std::uint64_t n = 0; n < recipe.iterations; ++n) {
    const core::Random random({recipe.seed, 0, kSomRandomComponent, n + 1});
    const double draw = random.uniform(0) * static_cast<double>(inputs.size());
    const double progress = static_cast<double>(n) / static_cast<double>(recipe.iterations);
    learn(lattice, inputs[static_cast<std::size_t>(draw)], annealed(recipe.learning_rate, progress),
          annealed(recipe.radius_neurons, progress));
  }
  // As the file will tell them, so that what is learned next is learned for the file.
  for (Som::Neuron& neuron : lattice) {
    for (double& weight : neuron.weights) weight = std::round(weight * 1e4) / 1e4;
  }
  return lattice;
}

/// The shortest runs, each of the three for itself, of every neuron that recalls a landmark of a
/// run.
using Bounds = std::map<std::uint32_t, RunLengths>;
Bounds recalled(const Som& map, const ClassesSeen& run, const RunLengths& least_runs) {
  Bounds bounds;
  for (const Sighting& sighting : sightings(run, least_runs)) {
    const Som::Recall recall = map.recall(sighting.first);
    if (recall.distance > kToleranceClasses) continue;
    RunLengths& least = bounds.try_emplace(recall.neuron, sighting.second).first->second;
    for (std::size_t k = 0; k < 3; ++k) least[k] = std::min(least[k], sighting.second[k]);
  }
  return bounds;
}

/// Krishna & Kalra 2000, section 3.2.1: what the copies of one world tell of the lower bounds.
core::Result<void> find_lower_bounds(const SomRecipe& recipe, const std::string& world,
                                     const RunPast& run_past, Som::Lattice& lattice) {
  const Som map(lattice);
  for (int copy = 0;; ++copy) {
    const double scale = 1.0 - copy * recipe.scale_step;
    if (scale < recipe.scale_step) break;
    const auto run = run_past(world, scale);
    if (!run.ok()) return run.error();
    if (run->empty()) break;
    for (const auto& [neuron, lengths] : recalled(map, *run, recipe.least_runs)) {
      auto& bounds = lattice[neuron].lower_bounds;
      if (!bounds) bounds = lengths;
      for (std::size_t k = 0; k < 3; ++k) (*bounds)[k] = std::min((*bounds)[k], lengths[k]);
    }
  }
  return {};
}

std::string describe(const Triple& classes) {
  return '[' + std::to_string(classes[0]) + ' ' + std::to_string(classes[1]) + ' ' +
         std::to_string(classes[2]) + ']';
}

std::string to_text(const SomRecipe& recipe, const std::string& command,
                    const Som::Lattice& lattice) {
  std::string text =
      "# SPDX-License-Identifier: Apache-2.0\n"
      "# Self-organising map of Krishna & Kalra 2000, section 3.2.1: 7 x 7 neurons, row by row.\n"
      "# Weights are classes, lower bounds ticks; a neuron without bounds stands for no landmark.\n"
      "# Made by the command below; do not edit.\n"
      "format: clew-krishna-kalra-som/1\n"
      "trained_by:\n  command: \"" +
      command + "\"\n  seed: " + std::to_string(recipe.seed) +
      "\n  iterations: " + std::to_string(recipe.iterations) + "\n  worlds:\n";
  for (const std::string& world : recipe.worlds) text += "    - " + world + '\n';
  text += "neurons:\n";
  for (const Som::Neuron& neuron : lattice) {
    char line[128];
    std::snprintf(line, sizeof line, "  - {weights: [%.4f, %.4f, %.4f]", neuron.weights[0],
                  neuron.weights[1], neuron.weights[2]);
    text += line;
    if (neuron.lower_bounds) {
      const RunLengths& t = *neuron.lower_bounds;
      text += ", lower_bounds: [" + std::to_string(t[0]) + ", " + std::to_string(t[1]) + ", " +
              std::to_string(t[2]) + ']';
    }
    text += "}\n";
  }
  return text;
}

}  // namespace

std::uint8_t mirrored(std::uint8_t spatial_class) {
  // Rows 1 to 8 of Table I are 1 + 4 [right far] + 2 [centre far] + [left far].
  if (spatial_class == 0) return 0;
  const int row = spatial_class - 1;
  return static_cast<std::uint8_t>(1 + ((row & 1) << 2) + (row & 2) + ((row & 4) >> 2));
}

core::Result<std::string> train_som(const SomRecipe& recipe, const RunPast& run_past,
                                    const std::string& command) {
  std::vector<ClassesSeen> runs;
  for (const std::string& world : recipe.worlds) {
    auto run = run_past(world, 1.0);
    if (!run.ok()) return run.error();
    runs.push_back(std::move(run).value());
  }
  const std::vector<Triple> inputs = landmarks(recipe, runs);
  if (inputs.empty()) return core::Error{"the runs show no landmark"};
  Som::Lattice lattice = train(recipe, inputs);
  const Som map(lattice);
  for (const Triple& input : inputs) {
    if (map.recall(input).distance > kToleranceClasses) {
      return core::Error{"the map did not learn the landmark " + describe(input) +
                         "; give it more iterations, or fewer of the " +
                         std::to_string(inputs.size()) + " landmarks"};
    }
  }
  for (const std::string& world : recipe.worlds) {
    CLEW_RETURN_IF_ERROR(find_lower_bounds(recipe, world, run_past, lattice));
  }
  return to_text(recipe, command, lattice);
}

}  // namespace clew::train
