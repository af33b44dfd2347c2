// SPDX-License-Identifier: Apache-2.0
#include "control/polar/polar_lattice.hpp"

#include <algorithm>
#include <cmath>

#include "core/check.hpp"

namespace clew::control {
namespace {

constexpr int kPowerSteps = 400;

double weight(const core::Vec2& between) {
  const double distance_m = core::length(between);
  return distance_m > 0.0 ? 1.0 / distance_m : 0.0;
}

}  // namespace

PolarLattice::PolarLattice(std::size_t rings, std::size_t sectors, double scope_m)
    : scope_m_(scope_m),
      ring_step_m_(scope_m / static_cast<double>(rings - 1)),
      directions_(sectors),
      weights_(rings) {
  CLEW_CHECK(rings >= 2 && sectors >= 3 && scope_m > 0.0, "a polar map without neighbours");
  for (std::size_t k = 0; k < sectors; ++k) directions_[k] = core::direction(bearing_rad(k));
  for (std::size_t i = 0; i < rings; ++i) {
    const core::Vec2 here = place({i, 0});
    if (i > 0) weights_[i].beside = weight(here - place({i, 1}));
    if (i + 1 == rings) continue;
    weights_[i].outward = weight(here - place({i + 1, 0}));
    weights_[i].outward_diagonal = weight(here - place({i + 1, 1}));
    weights_[i + 1].inward = weights_[i].outward;
    weights_[i + 1].inward_diagonal = weights_[i].outward_diagonal;
  }
}

double PolarLattice::bearing_rad(std::size_t sector) const {
  return core::wrap_angle_rad(2.0 * core::kPi * static_cast<double>(sector) /
                              static_cast<double>(directions_.size()));
}

PolarUnit PolarLattice::unit_at(const core::Vec2& place) const {
  const double distance_m = core::length(place);
  const double ring =
      std::min(std::round(distance_m / ring_step_m_), static_cast<double>(weights_.size() - 1));
  const double turns = core::atan2(place.y(), place.x()) / (2.0 * core::kPi);
  const auto count = static_cast<double>(directions_.size());
  const double sector = std::round((turns < 0.0 ? turns + 1.0 : turns) * count);
  return {static_cast<std::size_t>(ring), static_cast<std::size_t>(sector) % directions_.size()};
}

double PolarLattice::greatest_eigenvalue() const {
  std::vector<double> x(rings(), 1.0);
  std::vector<double> product(rings());
  double bound = 0.0;
  for (int step = 0; step < kPowerSteps; ++step) {
    bound = 0.0;
    double greatest = 0.0;
    for (std::size_t i = 0; i < rings(); ++i) {
      const Weights& w = weights_[i];
      product[i] = 2.0 * w.beside * x[i];
      if (i > 0) product[i] += (w.inward + 2.0 * w.inward_diagonal) * x[i - 1];
      if (i + 1 < rings()) product[i] += (w.outward + 2.0 * w.outward_diagonal) * x[i + 1];
      bound = std::max(bound, product[i] / x[i]);
      greatest = std::max(greatest, product[i]);
    }
    for (std::size_t i = 0; i < rings(); ++i) x[i] = product[i] / greatest;
  }
  return bound;
}

}  // namespace clew::control
