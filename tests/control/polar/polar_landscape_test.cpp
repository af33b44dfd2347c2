// SPDX-License-Identifier: Apache-2.0
#include "control/polar/polar_landscape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/random.hpp"

namespace clew::control {
namespace {

constexpr std::size_t kRings = 12;
constexpr std::size_t kSectors = 16;
constexpr double kScope_m = 2.2;
constexpr double kGain = 0.7;

PolarLandscape landscape() { return {PolarLattice(kRings, kSectors, kScope_m), kGain}; }

/// To rest: each call makes two patterns at least.
void settle_to_rest(PolarLandscape& map) {
  for (int i = 0; i < 200; ++i) map.settle(2);
}

std::vector<PolarUnit> all_units() {
  std::vector<PolarUnit> units;
  for (std::size_t ring = 0; ring < kRings; ++ring) {
    for (std::size_t sector = 0; sector < kSectors; ++sector) units.push_back({ring, sector});
  }
  return units;
}

std::vector<PolarUnit> neighbours(const PolarUnit& unit) {
  std::vector<PolarUnit> found;
  for (const int ring_step : {-1, 0, 1}) {
    for (const int sector_step : {-1, 0, 1}) {
      const auto ring = static_cast<std::ptrdiff_t>(unit.ring) + ring_step;
      if (ring < 0 || ring >= static_cast<std::ptrdiff_t>(kRings)) continue;
      if (ring_step == 0 && sector_step == 0) continue;
      const std::size_t sector =
          (unit.sector + kSectors + static_cast<std::size_t>(sector_step + 1) - 1) % kSectors;
      found.push_back({static_cast<std::size_t>(ring), sector});
    }
  }
  return found;
}

/// The paper's equations as they stand: all units at once, in long double, until nothing changes by
/// more than a part in 10^15.
std::vector<long double> parallel_equilibrium(const PolarLandscape& map) {
  const PolarLattice& lattice = map.lattice();
  const auto at = [](const PolarUnit& unit) { return unit.ring * kSectors + unit.sector; };
  std::vector<long double> v(kRings * kSectors, 0.0L);
  v[at(map.target())] = 1.0L;
  for (long double change = 1.0L; change > 1e-15L;) {
    change = 0.0L;
    std::vector<long double> next = v;
    for (const PolarUnit& unit : all_units()) {
      if (unit == map.target() || map.obstructed(unit)) continue;
      long double net = 0.0L;
      for (const PolarUnit& other : neighbours(unit)) {
        const core::Vec2 between = lattice.place(unit) - lattice.place(other);
        const double distance_m = core::length(between);
        if (distance_m > 0.0) net += v[at(other)] / static_cast<long double>(distance_m);
      }
      next[at(unit)] = std::tanh(static_cast<long double>(map.beta_m()) * net);
      if (next[at(unit)] > 0.0L) {
        change = std::max(change, (next[at(unit)] - v[at(unit)]) / next[at(unit)]);
      }
    }
    v = next;
  }
  return v;
}

TEST(PolarLandscape, RestsWhereParallelUpdatesRest) {
  const core::Random random({3, 0, 0, 0});
  for (std::uint32_t map_number = 0; map_number < 10; ++map_number) {
    PolarLandscape map = landscape();
    for (std::uint32_t i = 0; i < 6; ++i) {
      const std::uint32_t n = 2 * (6 * map_number + i);
      map.obstruct((0.3 + 1.8 * random.uniform(n)) *
                       core::direction(2.0 * core::kPi * random.uniform(n + 1)),
                   0.3);
    }
    map.set_target({3.0, 0.7});
    settle_to_rest(map);

    const std::vector<long double> reference = parallel_equilibrium(map);

    for (const PolarUnit& unit : all_units()) {
      const auto expected = reference[unit.ring * kSectors + unit.sector];
      const double log_activation = map.log_activation(unit);
      if (expected == 0.0L) {
        EXPECT_EQ(log_activation, -std::numeric_limits<double>::infinity());
      } else {
        // Rounding of some hundred updates, each of which contracts.
        EXPECT_NEAR(log_activation, static_cast<double>(std::log(expected)), 1e-11)
            << map_number << ": " << unit.ring << ' ' << unit.sector;
      }
    }
  }
}

TEST(PolarLandscape, HasNoPeakButTheTarget) {
  PolarLandscape map = landscape();
  for (double y = -0.9; y < 1.0; y += 0.15) map.obstruct({1.1, y}, 0.3);
  map.set_target({3.0, 0.0});
  settle_to_rest(map);

  for (const PolarUnit& unit : all_units()) {
    if (unit == map.target() || map.obstructed(unit)) continue;
    double greatest = -std::numeric_limits<double>::infinity();
    for (const PolarUnit& other : neighbours(unit)) {
      greatest = std::max(greatest, map.log_activation(other));
    }
    EXPECT_GT(greatest, map.log_activation(unit)) << unit.ring << ' ' << unit.sector;
  }
}

TEST(PolarLandscape, LeadsStraightToATargetThatNothingHides) {
  PolarLandscape map = landscape();
  map.set_target({5.0, 0.0});

  map.settle(8);

  EXPECT_TRUE((map.subgoal() == PolarUnit{kRings - 1, 0}));
  EXPECT_TRUE((map.target() == PolarUnit{kRings - 1, 0}));
}

TEST(PolarLandscape, LeadsToATargetInsideTheMapAndNotBeyond) {
  PolarLandscape map = landscape();
  map.set_target({0.0, 1.0});

  map.settle(8);

  EXPECT_TRUE((map.subgoal() == PolarUnit{5, 4}));  // rings are 0.2 m apart; sector 4 of 16: left
}

TEST(PolarLandscape, LeadsRoundAnObstacleOnTheShorterSide) {
  PolarLandscape map = landscape();
  // A wall at 0.8 m from 0.3 m on the right to 0.9 m on the left.
  for (double y = -0.3; y < 0.95; y += 0.1) map.obstruct({0.8, y}, 0.2);
  map.set_target({5.0, 0.0});

  map.settle(8);

  ASSERT_TRUE(map.subgoal().has_value());
  const double bearing_rad = map.lattice().bearing_rad(map.subgoal()->sector);
  // The disc at its right end spans the directions from atan(0.3 / 0.8) + asin(0.2 / 0.85) on.
  EXPECT_LT(bearing_rad, 0.0);
  EXPECT_GT(bearing_rad, -core::kPi / 2.0);
}

TEST(PolarLandscape, IsTheSameInTheMirror) {
  PolarLandscape map = landscape();
  PolarLandscape mirrored = landscape();
  for (const core::Vec2& place : {core::Vec2(0.7, 0.2), {0.9, -0.6}, {-0.3, 1.0}}) {
    map.obstruct(place, 0.25);
    mirrored.obstruct({place.x(), -place.y()}, 0.25);
  }
  map.set_target({2.0, 1.0});
  mirrored.set_target({2.0, -1.0});

  map.settle(8);
  mirrored.settle(8);

  for (const PolarUnit& unit : all_units()) {
    const PolarUnit image{unit.ring, (kSectors - unit.sector) % kSectors};
    ASSERT_EQ(map.obstructed(unit), mirrored.obstructed(image));
    if (map.obstructed(unit)) continue;
    EXPECT_NEAR(map.log_activation(unit), mirrored.log_activation(image), 1e-9);
  }
}

TEST(PolarLandscape, ObstructsWhatIsNearerThanTheRadius) {
  PolarLandscape map = landscape();
  const core::Vec2 place(0.9, -0.5);

  map.obstruct(place, 0.35);

  for (const PolarUnit& unit : all_units()) {
    const bool near = core::length(map.lattice().place(unit) - place) < 0.35;
    EXPECT_EQ(map.obstructed(unit), near) << unit.ring << ' ' << unit.sector;
  }
}

// Unit by unit, with rings of more than a word and sectors that are odd and few, or many.
TEST(PolarLandscape, ObstructsTheSameAsEachUnitAlone) {
  const core::Random random(core::RandomKey{3, 0, 0, 0});
  std::uint32_t drawn = 0;
  for (const std::size_t sectors : {9, 48, 256}) {
    for (int round = 0; round < 60; ++round) {
      PolarLandscape map({PolarLattice(130, sectors, 3.0), kGain});
      const double distance_m = 3.2 * random.uniform(drawn++);
      const core::Vec2 place =
          distance_m * core::direction(2.0 * core::kPi * random.uniform(drawn++));
      const double radius_m = 0.4 * random.uniform(drawn++);
      const double reach_m = std::min(radius_m, core::length(place));

      map.obstruct(place, radius_m);

      for (std::size_t sector = 0; sector < sectors; ++sector) {
        for (std::size_t ring = 0; ring < 130; ++ring) {
          const core::Vec2& direction = map.lattice().direction(sector);
          const double along_m = place.x() * direction.x() + place.y() * direction.y();
          const double across_m = place.x() * direction.y() - place.y() * direction.x();
          const double off_m = static_cast<double>(ring) * map.lattice().ring_step_m() - along_m;
          const bool inside = off_m * off_m + across_m * across_m < reach_m * reach_m;
          ASSERT_EQ(map.obstructed({ring, sector}), inside && ring > 0 && ring < 129)
              << place.x() << ' ' << place.y() << ' ' << radius_m << ": " << ring << ' ' << sector;
        }
      }
    }
  }
}

TEST(PolarLandscape, LetsTheRobotGoAwayFromWhatItIsCloseTo) {
  PolarLandscape map = landscape();
  map.obstruct({0.17, 0.0}, 0.22);  // closer than the radius
  map.set_target({-3.0, 0.0});

  map.settle(8);

  EXPECT_TRUE((map.subgoal() == PolarUnit{kRings - 1, kSectors / 2}));
  EXPECT_FALSE(map.obstructed({1, 4}));  // beside it, not nearer than now
}

TEST(PolarLandscape, HasNoSubgoalWhereEveryWayIsObstructed) {
  PolarLandscape map = landscape();
  for (int i = 0; i < 40; ++i) map.obstruct(core::direction(core::kPi * i / 20.0), 0.3);
  map.set_target({5.0, 0.0});

  const int patterns = map.settle(1000);

  EXPECT_FALSE(map.subgoal().has_value());
  EXPECT_EQ(map.log_activation({0, 0}), -std::numeric_limits<double>::infinity());
  EXPECT_LT(patterns, 50);  // as soon as nothing new is reached
}

TEST(PolarLandscape, ReachesARobotThatATargetInAnObstacleIsFarFrom) {
  PolarLandscape map = landscape();
  map.obstruct({1.0, 0.0}, 0.15);  // covers the unit of the target, and no neighbour
  map.set_target({1.0, 0.0});

  map.settle(8);

  EXPECT_TRUE(map.subgoal().has_value());
}

TEST(PolarLandscape, HoldsActivationsThatNoDoubleHolds) {
  PolarLandscape map({PolarLattice(300, 16, 2.54), 0.3});
  map.set_target({5.0, 0.0});

  map.settle(8);

  EXPECT_LT(map.log_activation({0, 0}), std::log(std::numeric_limits<double>::denorm_min()));
  EXPECT_TRUE((map.subgoal() == PolarUnit{299, 0}));
}

}  // namespace
}  // namespace clew::control
