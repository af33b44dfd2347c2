// SPDX-License-Identifier: Apache-2.0
#include "control/polar/polar_landscape.hpp"

#include <algorithm>
#include <cmath>

#include "core/check.hpp"

namespace clew::control {
namespace {

constexpr double kScale = 0x1p+1000;
constexpr double kInverseScale = 0x1p-1000;
constexpr double kLogScale = 1000.0 * 0.693147180559945309;
/// tanh(x) is x to the last bit below this: x^3 / 3 is less than half a unit in the last place.
constexpr double kIdentityBelow = 1e-8 * kScale;

}  // namespace

PolarLandscape::PolarLandscape(const PolarLattice& lattice, double gain_ratio)
    : lattice_(lattice),
      beta_m_(gain_ratio / lattice.greatest_eigenvalue()),
      stride_(lattice.sectors() + 2),
      activation_((lattice.rings() + 2) * stride_, 0.0),
      free_((lattice.rings() + 2) * stride_, 1.0),
      net_(lattice.sectors()) {
  CLEW_CHECK(gain_ratio > 0.0 && gain_ratio < 1.0, "a gain that is not stable");
  for (std::size_t ring = 0; ring < lattice.rings(); ++ring) {
    PolarLattice::Weights gain = lattice.weights(ring);
    for (double* g : {&gain.inward, &gain.inward_diagonal, &gain.outward, &gain.outward_diagonal,
                      &gain.beside}) {
      *g *= beta_m_;
    }
    gains_.push_back(gain);
  }
}

void PolarLandscape::clear() {
  std::fill(activation_.begin(), activation_.end(), 0.0);
  std::fill(free_.begin(), free_.end(), 1.0);
}

void PolarLandscape::obstruct(const core::Vec2& place, double radius_m) {
  const double distance_m = core::length(place);
  const double reach_m = std::min(radius_m, distance_m);
  const double step_m = lattice_.ring_step_m();
  const auto sectors = static_cast<std::ptrdiff_t>(lattice_.sectors());
  const double first = std::max(1.0, std::ceil((distance_m - reach_m) / step_m));
  const double last = std::min(static_cast<double>(lattice_.rings() - 2),
                               std::floor((distance_m + reach_m) / step_m));
  // Of the angle asin(reach / distance) that the disc spans no more than the chord over pi / 2.
  const double half_width =
      0.25 * static_cast<double>(sectors) * reach_m / std::max(distance_m, 1e-9);
  const auto spread = std::min(static_cast<std::ptrdiff_t>(half_width) + 1, sectors / 2);
  const auto middle = static_cast<std::ptrdiff_t>(lattice_.unit_at(place).sector);
  for (auto offset = -spread; offset <= spread; ++offset) {
    const auto sector = static_cast<std::size_t>((middle + offset + sectors) % sectors);
    const core::Vec2& direction = lattice_.direction(sector);
    const double along_m = place.x() * direction.x() + place.y() * direction.y();
    const double across_m = place.x() * direction.y() - place.y() * direction.x();
    const double across2 = across_m * across_m;
    for (double ring = first; ring <= last; ring += 1.0) {
      const double off_m = ring * step_m - along_m;
      if (off_m * off_m + across2 < reach_m * reach_m) {
        free_[index({static_cast<std::size_t>(ring), sector})] = 0.0;
      }
    }
  }
}

void PolarLandscape::set_target(const core::Vec2& place) {
  target_ = lattice_.unit_at(place);
  activation_[index(target_)] = kScale;
  close_ring(target_.ring);
}

int PolarLandscape::settle(int most_patterns) {
  std::optional<PolarUnit> before;
  std::ptrdiff_t at_rest_before = 0;
  for (int pattern = 1; pattern <= most_patterns; ++pattern) {
    for (std::size_t ring = lattice_.rings(); ring-- > 0;) update(ring);
    for (std::size_t ring = 1; ring < lattice_.rings(); ++ring) update(ring);
    const std::optional<PolarUnit> now = subgoal();
    if (now && before && *now == *before) return pattern;
    const auto at_rest = std::count(activation_.begin(), activation_.end(), 0.0);
    if (!now && at_rest == at_rest_before) return pattern;
    before = now;
    at_rest_before = at_rest;
  }
  return most_patterns;
}

void PolarLandscape::update(std::size_t ring) {
  const PolarLattice::Weights& gain = gains_[ring];
  const double* const inner = activation_.data() + row(ring) - stride_;
  const double* const outer = activation_.data() + row(ring) + stride_;
  const double* const free = free_.data() + row(ring);
  double* const own = activation_.data() + row(ring);
  double* const net = net_.data();
  const std::size_t sectors = lattice_.sectors();
  for (std::size_t k = 0; k < sectors; ++k) {
    net[k] = free[k + 1] * (gain.inward * inner[k + 1] + gain.outward * outer[k + 1] +
                            gain.inward_diagonal * (inner[k] + inner[k + 2]) +
                            gain.outward_diagonal * (outer[k] + outer[k + 2]) +
                            gain.beside * (own[k] + own[k + 2]));
  }
  std::copy(net, net + sectors, own + 1);
  // Beyond some units from the target all are small.
  if (*std::max_element(net, net + sectors) > kIdentityBelow) {
    for (std::size_t k = 1; k <= sectors; ++k) {
      if (own[k] > kIdentityBelow) own[k] = kScale * core::tanh(own[k] * kInverseScale);
    }
  }
  if (ring == target_.ring) own[target_.sector + 1] = kScale;
  close_ring(ring);
}

void PolarLandscape::close_ring(std::size_t ring) {
  double* const own = activation_.data() + row(ring);
  own[0] = own[lattice_.sectors()];
  own[lattice_.sectors() + 1] = own[1];
}

std::optional<std::size_t> PolarLandscape::best_sector() const {
  const auto first = activation_.begin() + static_cast<std::ptrdiff_t>(index({0, 0}));
  const auto best =
      std::max_element(first, first + static_cast<std::ptrdiff_t>(lattice_.sectors()));
  if (*best == 0.0) return std::nullopt;
  return static_cast<std::size_t>(best - first);
}

std::optional<PolarUnit> PolarLandscape::subgoal() const {
  const auto sector = best_sector();
  if (!sector) return std::nullopt;
  PolarUnit unit{0, *sector};
  while (unit.ring + 1 < lattice_.rings()) {
    const PolarUnit next{unit.ring + 1, *sector};
    if (activation_[index(next)] <= activation_[index(unit)]) break;
    unit = next;
  }
  return unit;
}

double PolarLandscape::log_activation(const PolarUnit& unit) const {
  return core::log(activation_[index(unit)]) - kLogScale;
}

}  // namespace clew::control
