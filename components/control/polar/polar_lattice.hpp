// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry.hpp"

namespace clew::control {

/// A unit of a polar map: sector 0 lies along the heading, the next ones go counter-clockwise.
struct PolarUnit {
  std::size_t ring = 0;
  std::size_t sector = 0;
};

inline bool operator==(const PolarUnit& a, const PolarUnit& b) {
  return a.ring == b.ring && a.sector == b.sector;
}

/// The units of a polar neural map and how they are connected: Lagoudakis & Maida 1999, *The Polar
/// Neural Map*. Each stands for a place of the robot's centre, in the frame of the map, which moves
/// and turns with the robot. Rings lie at equal distances, from the robot's own place (ring 0, the
/// inner ring: its sectors are headings) to the scope (the outer ring); sectors at equal angles.
///
/// A unit is connected to its eight neighbours on the lattice, with a weight of 1 / rho, rho being
/// the distance between their places, and 0 where rho is 0 (the paper's w_ij with f(x) = 1 / x): so
/// the units of the inner ring, which are all at one place, do not excite each other.
class PolarLattice {
 public:
  /// Weights of a unit of a ring to its neighbours, 1/m; the same for all sectors.
  struct Weights {
    double inward = 0.0;            ///< same sector, next ring toward the robot
    double inward_diagonal = 0.0;   ///< each of the two beside that
    double outward = 0.0;           ///< same sector, next ring away from the robot
    double outward_diagonal = 0.0;  ///< each of the two beside that
    double beside = 0.0;            ///< each of the two on the same ring
  };

  /// rings >= 2, sectors >= 3, scope_m > 0: the radius of the outer ring.
  PolarLattice(std::size_t rings, std::size_t sectors, double scope_m);

  std::size_t rings() const { return weights_.size(); }
  std::size_t sectors() const { return directions_.size(); }
  double scope_m() const { return scope_m_; }
  double ring_step_m() const { return ring_step_m_; }
  double radius_m(std::size_t ring) const { return static_cast<double>(ring) * ring_step_m_; }
  double bearing_rad(std::size_t sector) const;
  /// Unit vector of a sector.
  const core::Vec2& direction(std::size_t sector) const { return directions_[sector]; }
  core::Vec2 place(const PolarUnit& unit) const {
    return radius_m(unit.ring) * directions_[unit.sector];
  }
  /// The unit nearest to a place; of the outer ring, if the place is farther away.
  PolarUnit unit_at(const core::Vec2& place) const;

  const Weights& weights(std::size_t ring) const { return weights_[ring]; }

  /// The greatest eigenvalue of the connectivity, 1/m, or a little more: what bounds beta (*the
  /// stability condition*, beta < 1 / lambda). The connectivity is symmetric and the same in every
  /// sector, so that its Perron vector has one value a ring; for any positive vector x the greatest
  /// (W x)_i / x_i is no less than the eigenvalue (Collatz and Wielandt), and falls to it as x is
  /// multiplied by W again and again.
  double greatest_eigenvalue() const;

 private:
  double scope_m_;
  double ring_step_m_;
  std::vector<core::Vec2> directions_;
  std::vector<Weights> weights_;
};

}  // namespace clew::control
