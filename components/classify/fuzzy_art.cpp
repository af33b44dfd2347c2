// SPDX-License-Identifier: Apache-2.0
#include "classify/fuzzy_art.hpp"

#include <algorithm>

namespace clew::classify {
namespace {

constexpr double kHighestClass = 8.0;

/// Complement coding: Y = (y, 1 - y), classes scaled to 0..1.
std::array<double, 6> complement_coded(const Triple& classes) {
  std::array<double, 6> input{};
  for (std::size_t i = 0; i < 3; ++i) {
    input[i] = static_cast<double>(classes[i]) / kHighestClass;
    input[i + 3] = 1.0 - input[i];
  }
  return input;
}

double sum(const std::array<double, 6>& z) {
  double total = 0.0;
  for (const double component : z) total += component;
  return total;
}

/// |Y ^ Z|
double overlap(const std::array<double, 6>& y, const std::array<double, 6>& z) {
  double total = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) total += std::min(y[i], z[i]);
  return total;
}

}  // namespace

FuzzyArt::FuzzyArt(const FuzzyArtParameters& parameters) : parameters_(parameters) {
  state_.categories.resize(static_cast<std::size_t>(parameters.capacity));
}

FuzzyArt::Answer FuzzyArt::present(const Triple& classes, std::uint64_t tick) {
  forget(tick);
  const Input input = complement_coded(classes);
  const std::optional<std::uint32_t> winner = resonating(input);
  if (!winner) {
    const std::uint32_t slot = slot_for_new();
    state_.categories[slot] = {true, tick, input};
    return {slot, true};
  }
  Category& category = state_.categories[*winner];
  for (std::size_t i = 0; i < input.size(); ++i) {
    category.weights[i] = parameters_.learning_rate * std::min(input[i], category.weights[i]) +
                          (1.0 - parameters_.learning_rate) * category.weights[i];
  }
  category.last_win_tick = tick;
  return {*winner, false};
}

void FuzzyArt::forget(std::uint64_t tick) {
  if (parameters_.forget_ticks == 0) return;
  const auto forget_ticks = static_cast<std::uint64_t>(parameters_.forget_ticks);
  for (Category& category : state_.categories) {
    if (category.used && tick - category.last_win_tick > forget_ticks) category = {};
  }
}

/// The category of highest choice, the first of equals, among those that pass the vigilance test.
/// That is the outcome of the search of appendix B, which shuts down one failing winner after the
/// other.
std::optional<std::uint32_t> FuzzyArt::resonating(const Input& input) const {
  std::optional<std::uint32_t> winner;
  double highest_choice = 0.0;
  for (std::uint32_t j = 0; j < state_.categories.size(); ++j) {
    const Category& category = state_.categories[j];
    if (!category.used) continue;
    const double match = overlap(input, category.weights);
    if (match < parameters_.vigilance * sum(input)) continue;
    const double choice = match / (parameters_.choice_delta + sum(category.weights));
    if (!winner || choice > highest_choice) {
      winner = j;
      highest_choice = choice;
    }
  }
  return winner;
}

/// The first slot that is free, else the one whose category won least recently.
std::uint32_t FuzzyArt::slot_for_new() const {
  std::uint32_t oldest = 0;
  for (std::uint32_t j = 0; j < state_.categories.size(); ++j) {
    if (!state_.categories[j].used) return j;
    if (state_.categories[j].last_win_tick < state_.categories[oldest].last_win_tick) oldest = j;
  }
  return oldest;
}

std::array<double, 3> FuzzyArt::prototype(std::uint32_t category) const {
  const std::array<double, 6>& z = state_.categories[category].weights;
  std::array<double, 3> middle{};
  for (std::size_t i = 0; i < 3; ++i) middle[i] = 0.5 * kHighestClass * (z[i] + 1.0 - z[i + 3]);
  return middle;
}

}  // namespace clew::classify
