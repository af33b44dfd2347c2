// SPDX-License-Identifier: Apache-2.0
#include "train/larger_table.hpp"

#include <algorithm>

namespace clew::train {
namespace {

using Place = NeuroFuzzyNets::Place;

constexpr double kHalfAtMiddle = 0.42466;  // width over spacing: 1 / (2 sqrt(2 ln 2))
constexpr double kHoldsNowhere = 1e-6;
constexpr int kSweeps = 20;

bool looks_ahead(std::size_t net) { return net == Place::kLeft1 || net == Place::kRight1; }
double first_of(std::size_t net, const InfraredReadings& readings) {
  return readings[looks_ahead(net) ? control::kAhead : control::kLeft];
}
double second_of(std::size_t net, const InfraredReadings& readings) {
  return readings[looks_ahead(net) ? control::kBack : control::kRight];
}

/// The coarse table between its rules, at (row, column) in rows and columns.
double between(const NeuroFuzzyNets::Net::PerRule& outputs, double row, double column) {
  constexpr std::size_t kLast = NeuroFuzzyNets::kSets - 2;
  const std::size_t i = std::min(static_cast<std::size_t>(row), kLast);
  const std::size_t j = std::min(static_cast<std::size_t>(column), kLast);
  const double s = row - static_cast<double>(i);
  const double t = column - static_cast<double>(j);
  return (1.0 - s) * ((1.0 - t) * outputs[i][j] + t * outputs[i][j + 1]) +
         s * ((1.0 - t) * outputs[i + 1][j] + t * outputs[i + 1][j + 1]);
}

}  // namespace

LargerTable LargerTable::interpolated(const NeuroFuzzyNets& rules) {
  constexpr double kSpacing = static_cast<double>(NeuroFuzzyNets::kSets - 1) / (kSets - 1);
  LargerTable table;
  for (std::size_t k = 0; k < rules.nets.size(); ++k) {
    const NeuroFuzzyNets::Net& coarse = rules.nets[k];
    Net& fine = table.nets_[k];
    for (std::size_t input = 0; input < 2; ++input) {
      const double step = (coarse.centres[input].back() - coarse.centres[input].front()) /
                          static_cast<double>(kSets - 1);
      for (std::size_t i = 0; i < kSets; ++i) {
        fine.centres[input][i] = coarse.centres[input].front() + static_cast<double>(i) * step;
      }
      fine.widths[input].fill(step * kHalfAtMiddle);
    }
    for (std::size_t i = 0; i < kSets; ++i) {
      for (std::size_t j = 0; j < kSets; ++j) {
        fine.outputs[i][j] = between(coarse.outputs, static_cast<double>(i) * kSpacing,
                                     static_cast<double>(j) * kSpacing);
      }
    }
  }
  return table;
}

LargerTable LargerTable::filled(const NeuroFuzzyNets& rules,
                                const std::vector<TrainingGroup>& groups) {
  LargerTable table = interpolated(rules);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    table.fill(Place::kLeft1, Place::kLeft2, groups);
    table.fill(Place::kLeft2, Place::kLeft1, groups);
    table.fill(Place::kRight1, Place::kRight2, groups);
    table.fill(Place::kRight2, Place::kRight1, groups);
  }
  return table;
}

WheelSpeeds LargerTable::speeds(const InfraredReadings& readings) const {
  return {output(Place::kLeft1, readings) + output(Place::kLeft2, readings),
          output(Place::kRight1, readings) + output(Place::kRight2, readings)};
}

double LargerTable::output(std::size_t net, const InfraredReadings& readings) const {
  return nets_[net].infer(first_of(net, readings), second_of(net, readings));
}

void LargerTable::fill(std::size_t net, std::size_t other,
                       const std::vector<TrainingGroup>& groups) {
  Net::PerRule moment{};
  Net::PerRule weight{};
  const bool is_left = net == Place::kLeft1 || net == Place::kLeft2;
  for (const TrainingGroup& group : groups) {
    const double wanted_mps = is_left ? group.wanted.left_mps : group.wanted.right_mps;
    const double left_over_mps = wanted_mps - output(other, group.readings);
    const auto holds =
        nets_[net].gradient(first_of(net, group.readings), second_of(net, group.readings)).outputs;
    for (std::size_t i = 0; i < kSets; ++i) {
      for (std::size_t j = 0; j < kSets; ++j) {
        moment[i][j] += holds[i][j] * left_over_mps;
        weight[i][j] += holds[i][j];
      }
    }
  }
  for (std::size_t i = 0; i < kSets; ++i) {
    for (std::size_t j = 0; j < kSets; ++j) {
      if (weight[i][j] > kHoldsNowhere) nets_[net].outputs[i][j] = moment[i][j] / weight[i][j];
    }
  }
}

}  // namespace clew::train
