// SPDX-License-Identifier: Apache-2.0
#include "control/polar/polar_landscape.hpp"

#include <algorithm>
#include <cmath>

#include "control/polar/lanes.hpp"
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
      words_((lattice.rings() + kBits - 1) / kBits),
      activation_((lattice.rings() + 2) * stride_ + kLanes, 0.0),
      free_((lattice.rings() + 2) * stride_ + kLanes, 1.0),
      obstructed_(lattice.sectors() * words_, 0),
      net_(lattice.sectors() + kLanes) {
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
  std::fill(obstructed_.begin(), obstructed_.end(), 0);
}

/// Tests units with the exact inequality, but in each sector only those where it may change: the
/// obstructed ones are rings in a row.
void PolarLandscape::obstruct(const core::Vec2& place, double radius_m) {
  const double distance_m = core::length(place);
  const double reach_m = std::min(radius_m, distance_m);
  const double reach2_m2 = reach_m * reach_m;
  const double step_m = lattice_.ring_step_m();
  const auto sectors = static_cast<std::ptrdiff_t>(lattice_.sectors());
  const auto rings = static_cast<double>(lattice_.rings());
  const auto first = static_cast<std::ptrdiff_t>(
      std::max(1.0, std::ceil(std::min((distance_m - reach_m) / step_m, rings))));
  const auto last = static_cast<std::ptrdiff_t>(
      std::min(rings - 2.0, std::floor((distance_m + reach_m) / step_m)));
  if (first > last) return;
  // Of the angle asin(reach / distance) that the disc spans no more than the chord over pi / 2; one
  // for the rounding of the middle, and one for its error.
  const double half_width =
      0.25 * static_cast<double>(sectors) * reach_m / std::max(distance_m, 1e-9);
  const auto spread = std::min(static_cast<std::ptrdiff_t>(half_width) + 2, sectors / 2);
  const std::ptrdiff_t middle = roughly_sector_of(place);
  for (auto offset = -spread; offset <= spread; ++offset) {
    const auto sector = static_cast<std::size_t>((middle + offset + sectors) % sectors);
    const core::Vec2& direction = lattice_.direction(sector);
    const double along_m = place.x() * direction.x() + place.y() * direction.y();
    const double across_m = place.x() * direction.y() - place.y() * direction.x();
    const double across2 = across_m * across_m;
    if (across2 >= reach2_m2) continue;
    const auto covers = [&](std::ptrdiff_t ring) {
      const double off_m = static_cast<double>(ring) * step_m - along_m;
      return off_m * off_m + across2 < reach2_m2;
    };
    const double half_m = std::sqrt(reach2_m2 - across2);
    auto from = std::max(first, static_cast<std::ptrdiff_t>((along_m - half_m) / step_m));
    auto to = std::min(last, static_cast<std::ptrdiff_t>((along_m + half_m) / step_m));
    while (from > first && covers(from - 1)) --from;
    while (to < last && covers(to + 1)) ++to;
    while (from <= to && !covers(from)) ++from;
    while (from <= to && !covers(to)) --to;
    if (from <= to) {
      obstruct(sector, static_cast<std::size_t>(from), static_cast<std::size_t>(to));
    }
  }
}

/// The sector of a place, at most one off: the angle's tangent in its octant by a parabola, which
/// is off by 0.005 rad at most.
std::ptrdiff_t PolarLandscape::roughly_sector_of(const core::Vec2& place) const {
  const double x = std::fabs(place.x());
  const double y = std::fabs(place.y());
  const double greater = std::max(x, y);
  if (greater == 0.0) return 0;
  const double tangent = std::min(x, y) / greater;
  double angle_rad = tangent * (0.25 * core::kPi + 0.273 * (1.0 - tangent));
  if (y > x) angle_rad = 0.5 * core::kPi - angle_rad;
  if (place.x() < 0.0) angle_rad = core::kPi - angle_rad;
  if (place.y() < 0.0) angle_rad = 2.0 * core::kPi - angle_rad;
  const auto sectors = static_cast<std::ptrdiff_t>(lattice_.sectors());
  const double turns = angle_rad / (2.0 * core::kPi);
  return static_cast<std::ptrdiff_t>(turns * static_cast<double>(sectors) + 0.5) % sectors;
}

/// Obstructs rings in a row.
void PolarLandscape::obstruct(std::size_t sector, std::size_t from, std::size_t to) {
  std::uint64_t* const words = obstructed_.data() + sector * words_;
  for (std::size_t word = from / kBits; word <= to / kBits; ++word) {
    std::uint64_t bits = ~std::uint64_t{0};
    if (word == from / kBits) bits &= ~std::uint64_t{0} << (from % kBits);
    if (word == to / kBits) bits &= ~std::uint64_t{0} >> (kBits - 1 - to % kBits);
    words[word] |= bits;
  }
}

/// Writes what is obstructed as factors, which rings are updated with.
void PolarLandscape::lay_out_free() {
  std::fill(free_.begin(), free_.end(), 1.0);
  for (std::size_t sector = 0; sector < lattice_.sectors(); ++sector) {
    for (std::size_t word = 0; word < words_; ++word) {
      for (std::uint64_t bits = obstructed_[sector * words_ + word]; bits != 0; bits &= bits - 1) {
        const std::size_t ring = word * kBits + static_cast<std::size_t>(__builtin_ctzll(bits));
        free_[index({ring, sector})] = 0.0;
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
  lay_out_free();
  for (int pattern = 1; pattern <= most_patterns; ++pattern) {
    for (std::size_t ring = lattice_.rings(); ring-- > 0;) update(ring);
    for (std::size_t ring = 1; ring < lattice_.rings(); ++ring) update(ring);
    const std::optional<PolarUnit> now = subgoal();
    if (now && before && *now == *before) return pattern;
    before = now;
    if (now) continue;  // activation grows only: the robot will always be reached from now on
    const auto at_rest = std::count(activation_.begin(), activation_.end(), 0.0);
    if (at_rest == at_rest_before) return pattern;
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
  Lanes greatest{};
  // With an odd number of sectors the last lane is of the row's margin, and void.
  for (std::size_t k = 0; k < sectors; k += kLanes) {
    const Lanes inward = load_lanes(inner + k) + load_lanes(inner + k + 2);
    const Lanes outward = load_lanes(outer + k) + load_lanes(outer + k + 2);
    const Lanes beside = load_lanes(own + k) + load_lanes(own + k + 2);
    const Lanes sum =
        load_lanes(free + k + 1) *
        (gain.inward * load_lanes(inner + k + 1) + gain.outward * load_lanes(outer + k + 1) +
         gain.inward_diagonal * inward + gain.outward_diagonal * outward + gain.beside * beside);
    greatest = sum > greatest ? sum : greatest;
    store_lanes(sum, net + k);
  }
  std::copy(net, net + sectors, own + 1);
  // Beyond some units from the target all are small.
  if (std::max(greatest[0], greatest[1]) > kIdentityBelow) {
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
