// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "classify/class_sequence.hpp"
#include "core/archive.hpp"

namespace clew::classify {

struct FuzzyArtParameters {
  double vigilance = 0.9;           ///< rho
  double learning_rate = 0.85;      ///< beta
  double choice_delta = 0.001;      ///< delta
  std::int64_t capacity = 15;       ///< categories
  std::int64_t forget_ticks = 400;  ///< without a win; 0 is never
};

/// Fuzzy ART with complement coding, which learns landmark vectors as they come: Krishna & Kalra
/// 2000, appendix B (Carpenter, Grossberg & Rosen 1991). With y the classes / 8, Y = (y, 1 - y),
/// ^ the componentwise minimum and |.| the sum:
///
///     choice     T_j = |Y ^ Z_j| / (delta + |Z_j|)
///     vigilance  |Y ^ Z_j| / |Y| >= rho
///     learning   Z_J = beta (Y ^ Z_J) + (1 - beta) Z_J
///
/// Since |Y| = 3, rho = 0.9 takes vectors together whose classes differ by at most 2.4 in sum. A
/// new category is committed at once: Z = Y.
///
/// *Deviation:* the paper forgets a category after 100 samples without a win. Limit cycles last up
/// to 180 here, so it is 400, and when all are taken the one that won least recently gives way.
class FuzzyArt {
 public:
  struct Category {
    bool used = false;
    std::uint64_t last_win_tick = 0;
    std::array<double, 6> weights{};  ///< Z: low corner, then 1 - high corner
  };
  struct State {
    std::vector<Category> categories;  ///< one for each of the capacity
  };
  struct Answer {
    std::uint32_t category = 0;
    bool created = false;
  };

  explicit FuzzyArt(const FuzzyArtParameters& parameters);

  /// Classifies a landmark vector at `tick` and learns it.
  Answer present(const Triple& classes, std::uint64_t tick);

  /// The middle of what a category holds, in classes 0..8.
  std::array<double, 3> prototype(std::uint32_t category) const;

  State& state() { return state_; }
  const State& state() const { return state_; }

 private:
  using Input = std::array<double, 6>;
  void forget(std::uint64_t tick);
  std::optional<std::uint32_t> resonating(const Input& input) const;
  std::uint32_t slot_for_new() const;

  FuzzyArtParameters parameters_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, FuzzyArt::Category& c) {
  visit(c.used, c.last_win_tick, c.weights);
}
template <typename Visitor>
void visit_fields(Visitor& visit, FuzzyArt::State& s) {
  visit(s.categories);
}

}  // namespace clew::classify
