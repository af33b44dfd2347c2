// SPDX-License-Identifier: Apache-2.0
#include "train/neuro_fuzzy_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/random.hpp"

namespace clew::train {
namespace {

constexpr std::uint32_t kOutputRandomComponent = 103;  // apart from those of the stages
// Sets of that width, as share of the distance of their centres, meet at a half.
constexpr double kWidthShare = 0.42466;
constexpr std::size_t kSensors = std::tuple_size_v<InfraredReadings>;
constexpr double kLeastShare = 0.5;
constexpr double kReach_widths = 2.0;

/// Which of the four sensors is an input of a network.
std::size_t sensor_of(std::size_t net, std::size_t input) {
  const bool ahead_back = net == NeuroFuzzyNets::kLeft1 || net == NeuroFuzzyNets::kRight1;
  if (ahead_back) return input == 0 ? control::kAhead : control::kBack;
  return input == 0 ? control::kLeft : control::kRight;
}

struct Span {
  double least = NeuroFuzzyNets::kCentres.max;
  double most = NeuroFuzzyNets::kCentres.min;
};

Span span_of(const std::vector<TrainingGroup>& groups, std::size_t sensor) {
  Span span;
  for (const TrainingGroup& group : groups) {
    span.least = std::min(span.least, group.readings[sensor]);
    span.most = std::max(span.most, group.readings[sensor]);
  }
  return span;
}

/// The four sensors are of one kind: what one of them did not read yet, another did.
void lay_over(const std::vector<TrainingGroup>& groups, NeuroFuzzyNets& nets) {
  Span all;
  for (std::size_t sensor = 0; sensor < kSensors; ++sensor) {
    const Span span = span_of(groups, sensor);
    all = {std::min(all.least, span.least), std::max(all.most, span.most)};
  }
  const double step = (all.most - all.least) / static_cast<double>(NeuroFuzzyNets::kSets - 1);
  for (std::size_t k = 0; k < NeuroFuzzyNets::kCount; ++k) {
    for (std::size_t input = 0; input < 2; ++input) {
      for (std::size_t i = 0; i < NeuroFuzzyNets::kSets; ++i) {
        nets.nets[k].centres[input][i] = all.least + static_cast<double>(i) * step;
        nets.nets[k].widths[input][i] = std::max(NeuroFuzzyNets::kWidths.min, kWidthShare * step);
      }
    }
  }
}

void draw_outputs(std::uint64_t seed, NeuroFuzzyNets& nets) {
  for (std::size_t k = 0; k < NeuroFuzzyNets::kCount; ++k) {
    const core::Random random({seed, 0, kOutputRandomComponent, k});
    const bool as_one = nets.nets[k].ignores_second();
    std::uint32_t draw = 0;
    for (auto& row : nets.nets[k].outputs) {
      const double of_row = random.uniform(draw);
      for (double& output : row) output = as_one ? of_row : random.uniform(draw++);
      if (as_one) ++draw;
    }
  }
}

bool is_within(const NeuroFuzzyNets::Net& net, std::size_t input, double reading) {
  for (std::size_t i = 0; i < NeuroFuzzyNets::kSets; ++i) {
    const double off = std::fabs(reading - net.centres[input][i]);
    if (off <= kReach_widths * net.widths[input][i]) return true;
  }
  return false;
}

/// An error if too few readings lie in the sets of a network.
core::Result<void> check_sets(const NeuroFuzzyNets& nets,
                              const std::vector<TrainingGroup>& groups) {
  for (std::size_t k = 0; k < NeuroFuzzyNets::kCount; ++k) {
    for (std::size_t input = 0; input < 2; ++input) {
      const NeuroFuzzyNets::Net& net = nets.nets[k];
      const std::size_t sensor = sensor_of(k, input);
      const auto within = std::count_if(groups.begin(), groups.end(), [&](const auto& group) {
        return is_within(net, input, group.readings[sensor]);
      });
      const double share = static_cast<double>(within) / static_cast<double>(groups.size());
      if (share >= kLeastShare) continue;
      const Span span = span_of(groups, sensor);
      const auto [low, high] =
          std::minmax_element(net.centres[input].begin(), net.centres[input].end());
      return core::Error{fmt::format(
          "{:.0f} % of what sensor I_{} read lies in the sets of the rules that training begins "
          "with: readings from {:.0f} to {:.0f}, centres from {:.0f} to {:.0f}; the recipe key "
          "'sets: readings' lays them over the readings, as in the recipe "
          "wang_yang_meng_readings",
          100.0 * share, sensor + 1, span.least, span.most, *low, *high)};
    }
  }
  return {};
}

}  // namespace

core::Result<NeuroFuzzyNets> start_networks(const NeuroFuzzyRecipe& recipe,
                                            const NeuroFuzzyNets& rules,
                                            const TrainingGroups& groups) {
  NeuroFuzzyNets nets = rules;
  if (recipe.sets == StartSets::kReadings) lay_over(groups.train, nets);
  if (recipe.outputs == StartOutputs::kRandom) draw_outputs(recipe.seed, nets);
  CLEW_RETURN_IF_ERROR(check_sets(nets, groups.train));
  return nets;
}

}  // namespace clew::train
