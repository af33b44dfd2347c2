// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "control/polar/polar_lattice.hpp"

namespace clew::control {

/// The activation of a polar neural map: Lagoudakis & Maida 1999, *Neural Maps* and *The Polar
/// Neural Map*. Each unit takes
///
///     v_i = Phi(sum_j w_ij v_j),  Phi(x) = 0 for x <= 0, tanh(beta x) for x > 0,
///
/// but a target, whose external input of +inf makes it 1, and an obstructed unit, whose -inf makes
/// it 0. beta < 1 / lambda, lambda the greatest eigenvalue of the connectivity, so that there is
/// one equilibrium.
///
/// Units are brought up to date one ring after the other, from the outer ring to the inner one and
/// back: this is a *pattern*. A ring is updated as a whole from what it was and from its neighbours
/// as they are, so left and right are alike. Since all weights are positive and all units begin at
/// 0, activations only grow, and reach the same equilibrium in any order. It ends after a whole
/// pattern, when the inner ring is reached and the subgoal is that of the pattern before, or when
/// it is not reached and no unit was reached that was not before.
///
/// Activation falls by a constant factor a unit, to 1e-150 over 100 rings, and ways that lead to
/// and fro fall below what a double can hold. So activations are held 2^1000 times as large, which
/// is exact and gives 600 decades; where they are below 1e-8, tanh is the identity to the last bit.
class PolarLandscape {
 public:
  /// gain_ratio: beta times the greatest eigenvalue, in (0, 1).
  PolarLandscape(const PolarLattice& lattice, double gain_ratio);

  const PolarLattice& lattice() const { return lattice_; }
  double beta_m() const { return beta_m_; }

  /// No obstacles, no target, and all units at rest.
  void clear();

  /// Obstructs the units nearer than radius_m to a place; but from where the robot is it may go
  /// away from it, so the disc does not reach over the robot's own place. The inner and the outer
  /// ring are never obstructed.
  void obstruct(const core::Vec2& place, double radius_m);

  /// Makes the unit nearest to a place the target, or the one of the outer ring in its direction.
  /// It is a target even where it was obstructed.
  void set_target(const core::Vec2& place);

  /// At most this many patterns from where it is; returns how many it took.
  int settle(int most_patterns);

  /// Where to go: along the best unit of the inner ring, as far as activation rises in this
  /// direction. Nothing if activation does not reach the robot: every way is obstructed.
  std::optional<PolarUnit> subgoal() const;

  const PolarUnit& target() const { return target_; }
  bool obstructed(const PolarUnit& unit) const {
    const std::uint64_t word = obstructed_[unit.sector * words_ + unit.ring / kBits];
    return (word >> (unit.ring % kBits) & 1U) != 0;
  }
  /// Natural logarithm of the activation, which may be too small for a double; -infinity at 0.
  double log_activation(const PolarUnit& unit) const;

 private:
  static constexpr std::size_t kBits = 64;

  /// A row has the sectors, and one more on each side: the ring closes.
  std::size_t row(std::size_t ring) const { return (ring + 1) * stride_; }
  std::size_t index(const PolarUnit& unit) const { return row(unit.ring) + 1 + unit.sector; }
  void obstruct(std::size_t sector, std::size_t from, std::size_t to);
  std::ptrdiff_t roughly_sector_of(const core::Vec2& place) const;
  void lay_out_free();
  void update(std::size_t ring);
  void close_ring(std::size_t ring);
  std::optional<std::size_t> best_sector() const;

  PolarLattice lattice_;
  double beta_m_;
  std::size_t stride_;
  std::size_t words_;                         // of a sector's rings
  std::vector<PolarLattice::Weights> gains_;  // beta w, by ring
  std::vector<double> activation_;            // by row, with a row of zeros on each side
  std::vector<double> free_;                  // 1 or 0, by row, while it settles
  std::vector<std::uint64_t> obstructed_;     // a bit a ring, by sector
  std::vector<double> net_;                   // scratch: net input of a ring
  PolarUnit target_;
};

}  // namespace clew::control
