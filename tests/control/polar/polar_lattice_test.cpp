// SPDX-License-Identifier: Apache-2.0
#include "control/polar/polar_lattice.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

namespace clew::control {
namespace {

TEST(PolarLattice, PutsUnitsOnRingsFromTheRobotToTheScope) {
  const PolarLattice lattice(11, 8, 2.0);

  EXPECT_EQ(lattice.ring_step_m(), 0.2);
  EXPECT_NEAR(lattice.radius_m(10), 2.0, 1e-15);
  EXPECT_EQ(lattice.place({0, 3}), core::Vec2(0.0, 0.0));
  EXPECT_NEAR(lattice.place({5, 2}).x(), 0.0, 1e-15);  // sector 2 of 8: 90 degrees to the left
  EXPECT_NEAR(lattice.place({5, 2}).y(), 1.0, 1e-15);
  EXPECT_NEAR(lattice.bearing_rad(6), -core::kPi / 2.0, 1e-15);
}

TEST(PolarLattice, FindsEachUnitAtItsOwnPlace) {
  const PolarLattice lattice(10, 32, 2.54);

  for (std::size_t ring = 1; ring < lattice.rings(); ++ring) {
    for (std::size_t sector = 0; sector < lattice.sectors(); ++sector) {
      EXPECT_TRUE((lattice.unit_at(lattice.place({ring, sector})) == PolarUnit{ring, sector}));
    }
  }
}

TEST(PolarLattice, TakesWhatIsBeyondTheScopeToTheOuterRing) {
  const PolarLattice lattice(10, 32, 2.54);

  EXPECT_TRUE((lattice.unit_at({0.0, -50.0}) == PolarUnit{9, 24}));
  // 2.8 degrees right of the heading: sector 0 reaches 5.6 degrees to each side.
  EXPECT_TRUE((lattice.unit_at({100.0, -5.0}) == PolarUnit{9, 0}));
}

TEST(PolarLattice, WeighsNeighboursByTheReciprocalOfTheirDistance) {
  const PolarLattice lattice(5, 4, 4.0);  // rings 1 m apart, sectors a right angle

  const PolarLattice::Weights& second = lattice.weights(2);

  EXPECT_NEAR(second.inward, 1.0, 1e-15);
  EXPECT_NEAR(second.outward, 1.0, 1e-15);
  EXPECT_NEAR(second.inward_diagonal, 1.0 / std::sqrt(5.0), 1e-15);    // (2, 0) and (0, 1)
  EXPECT_NEAR(second.outward_diagonal, 1.0 / std::sqrt(13.0), 1e-15);  // (2, 0) and (0, 3)
  EXPECT_NEAR(second.beside, 1.0 / std::sqrt(8.0), 1e-15);             // (2, 0) and (0, 2)
}

TEST(PolarLattice, LeavesUnitsAtTheSamePlaceUnconnected) {
  const PolarLattice lattice(5, 4, 4.0);

  EXPECT_EQ(lattice.weights(0).beside, 0.0);
  EXPECT_NEAR(lattice.weights(0).outward_diagonal, 1.0, 1e-15);  // all of ring 1 are 1 m away
  EXPECT_EQ(lattice.weights(4).outward, 0.0);
}

/// The connectivity of all units as a matrix.
Eigen::MatrixXd connectivity(const PolarLattice& lattice) {
  const auto sectors = static_cast<Eigen::Index>(lattice.sectors());
  const auto rings = static_cast<Eigen::Index>(lattice.rings());
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(rings * sectors, rings * sectors);
  for (Eigen::Index ring = 0; ring < rings; ++ring) {
    const PolarLattice::Weights& weights = lattice.weights(static_cast<std::size_t>(ring));
    for (Eigen::Index k = 0; k < sectors; ++k) {
      const Eigen::Index left = (k + 1) % sectors;
      const Eigen::Index right = (k + sectors - 1) % sectors;
      const Eigen::Index unit = ring * sectors + k;
      w(unit, ring * sectors + left) = w(unit, ring * sectors + right) = weights.beside;
      if (ring > 0) {
        w(unit, (ring - 1) * sectors + k) = weights.inward;
        w(unit, (ring - 1) * sectors + left) = weights.inward_diagonal;
        w(unit, (ring - 1) * sectors + right) = weights.inward_diagonal;
      }
      if (ring + 1 < rings) {
        w(unit, (ring + 1) * sectors + k) = weights.outward;
        w(unit, (ring + 1) * sectors + left) = weights.outward_diagonal;
        w(unit, (ring + 1) * sectors + right) = weights.outward_diagonal;
      }
    }
  }
  return w;
}

TEST(PolarLattice, BoundsTheGreatestEigenvalueFromAboveAndClosely) {
  for (const auto& [rings, sectors] : {std::pair{4, 8}, {10, 32}, {20, 16}}) {
    const PolarLattice lattice(static_cast<std::size_t>(rings), static_cast<std::size_t>(sectors),
                               2.54);
    const Eigen::MatrixXd w = connectivity(lattice);
    ASSERT_EQ(w, w.transpose());
    const double truth = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(w).eigenvalues().maxCoeff();

    const double bound = lattice.greatest_eigenvalue();

    EXPECT_GE(bound, truth * (1.0 - 1e-12)) << rings << " x " << sectors;
    EXPECT_LE(bound, truth * 1.01) << rings << " x " << sectors;
  }
}

}  // namespace
}  // namespace clew::control
