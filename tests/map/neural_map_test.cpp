// SPDX-License-Identifier: Apache-2.0
#include "map/neural_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>

#include "random_map.hpp"

namespace clew::map {
namespace {

constexpr Lattice kLattices[] = {Lattice::kFourNeighbours, Lattice::kEightNeighbours,
                                 Lattice::kHexagonal};

NeuralMap neural_map(Lattice lattice = Lattice::kEightNeighbours, double gain = 0.1) {
  return NeuralMap::create({lattice, gain}).value();
}

// Which cells the target is connected to, by breadth-first search.
std::vector<bool> connected(const RandomMap& map, Lattice lattice, const Cell& target) {
  std::vector<bool> found(map.grid.size(), false);
  std::deque<Cell> open;
  if (map.passable[map.grid.index(target)] != 0) {
    found[map.grid.index(target)] = true;
    open.push_back(target);
  }
  for (; !open.empty(); open.pop_front()) {
    for (const Cell& next : neighbours(lattice, Cell(open.front()))) {
      if (!map.grid.contains(next) || map.passable[map.grid.index(next)] == 0) continue;
      if (found[map.grid.index(next)]) continue;
      found[map.grid.index(next)] = true;
      open.push_back(next);
    }
  }
  return found;
}

// The landscape at rest, by parallel updates of all units in long doubles, whose range of 10^4932
// maps of some 40 x 40 do not exhaust; at rest when no activation grows by more than 1e-18 of it.
std::vector<long double> reference(const RandomMap& map, Lattice lattice, const Cell& target,
                                   double gain) {
  std::vector<long double> now(map.grid.size(), 0.0L);
  for (bool at_rest = false; !at_rest;) {
    std::vector<long double> next(map.grid.size(), 0.0L);
    at_rest = true;
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (map.passable[i] == 0) continue;
      const Cell cell = map.grid.cell(i);
      long double sum = 0.0L;
      for (const Cell& other : neighbours(lattice, cell)) {
        if (!map.grid.contains(other)) continue;
        const bool diagonal = other.column != cell.column && other.row != cell.row;
        const long double weight =
            diagonal && lattice == Lattice::kEightNeighbours ? 1.0L / std::sqrt(2.0L) : 1.0L;
        sum += weight * now[map.grid.index(other)];
      }
      const bool dear = map.passable[i] == NeuralMap::kDear;
      const long double slope = dear ? NeuralMap::kLeastGain : gain;
      next[i] = cell == target ? 1.0L : std::tanh(slope * sum);
      if (next[i] - now[i] > 1e-18L * next[i]) at_rest = false;
    }
    now = std::move(next);
  }
  return now;
}

// Every pair of neighbours of every passable cell is ordered as in the reference. Pairs that differ
// there by less than 1e-12 of themselves count as equal: mirror images whose surroundings differ
// only far away, below what doubles can tell.
void expect_same_order(const NeuralMap& landscape, const RandomMap& map,
                       const std::vector<long double>& expected) {
  for (std::size_t i = 0; i < map.grid.size(); ++i) {
    const Neighbours around = neighbours(landscape.lattice(), map.grid.cell(i));
    for (const Cell& a : around) {
      for (const Cell& b : around) {
        if (map.passable[i] == 0 || !map.grid.contains(a) || !map.grid.contains(b)) continue;
        const long double expected_a = expected[map.grid.index(a)];
        const long double expected_b = expected[map.grid.index(b)];
        if (expected_a <= expected_b * (1.0L + 1e-12L)) continue;
        ASSERT_TRUE(landscape.above(a, b)) << "around cell " << i;
      }
    }
  }
}

// What is connected to the target has a higher neighbour, so no place is flat or a false summit,
// and the ascent ends at the target; all else is exactly zero.
void expect_ways_to(const NeuralMap& landscape, const RandomMap& map, const Cell& target) {
  const std::vector<bool> has_way = connected(map, landscape.lattice(), target);
  for (std::size_t i = 0; i < map.grid.size(); ++i) {
    const Cell cell = map.grid.cell(i);
    ASSERT_EQ(landscape.active(cell), has_way[i]) << i;
    if (!has_way[i] || cell == target) continue;
    const std::optional<Cell> next = landscape.ascent(cell);
    ASSERT_TRUE(next.has_value()) << i;
    // Each step ends strictly higher: it comes by no cell again, and only a target has no next.
    ASSERT_TRUE(landscape.above(*next, cell)) << i;
  }
}

// The same by going all the way, which takes time on a large map.
void expect_ascent_to(const NeuralMap& landscape, const RandomMap& map, const Cell& target) {
  const std::vector<bool> has_way = connected(map, landscape.lattice(), target);
  std::vector<Cell> path;
  for (std::size_t i = 0; i < map.grid.size(); ++i) {
    ASSERT_EQ(landscape.path(map.grid.cell(i), path), has_way[i]) << i;
    ASSERT_TRUE(!has_way[i] || path.back() == target) << i;
  }
}

TEST(NeuralMap, OrdersAllNeighboursAsTheHighPrecisionReferenceDoes) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Lattice lattice = kLattices[seed % 3];
    RandomMap map = random_map(seed, 41, 29, 0.02 * static_cast<double>(seed % 16), 3);
    const Cell target{static_cast<std::int32_t>(seed % 41), static_cast<std::int32_t>(seed % 29)};
    map.passable[map.grid.index(target)] = 1;
    NeuralMap landscape = neural_map(lattice);

    const NeuralMap::Evolution evolution = landscape.evolve(map.grid, map.passable, {target});

    EXPECT_TRUE(evolution.at_rest);
    expect_same_order(landscape, map, reference(map, lattice, target, 0.1));
    expect_ways_to(landscape, map, target);
    expect_ascent_to(landscape, map, target);
    if (HasFatalFailure()) FAIL() << "map " << seed;
  }
}

TEST(NeuralMap, OrdersAllNeighboursAsTheReferenceDoesWithDearCells) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Lattice lattice = kLattices[seed % 3];
    RandomMap map = random_map(seed, 31, 29, 0.15, 2);
    const RandomMap dear = random_map(seed + 1000, 31, 29, 0.01 * static_cast<double>(seed), 3);
    for (std::size_t i = 0; i < map.passable.size(); ++i) {
      if (map.passable[i] != 0 && dear.passable[i] == 0) map.passable[i] = NeuralMap::kDear;
    }
    const Cell target{static_cast<std::int32_t>(seed % 31), static_cast<std::int32_t>(seed % 29)};
    map.passable[map.grid.index(target)] = NeuralMap::kFree;
    NeuralMap landscape = neural_map(lattice);

    landscape.evolve(map.grid, map.passable, {target});

    expect_same_order(landscape, map, reference(map, lattice, target, 0.1));
    expect_ways_to(landscape, map, target);
    expect_ascent_to(landscape, map, target);
    if (HasFatalFailure()) FAIL() << "map " << seed;
  }
}

TEST(NeuralMap, LeadsRoundDearCellsWhereThatIsNotMuchFarther) {
  // A wall of dear cells three thick: straight on is 20 cells, of which 3 count as five or six
  // each, that is 33 or more; round an end 6 rows off it is some 20 + 0.41 * 12 = 25 steps.
  RandomMap map = random_map(1, 21, 31, 0.0, 0);
  for (std::int32_t row = 10; row <= 20; ++row) {
    for (std::int32_t column = 9; column <= 11; ++column) {
      map.passable[map.grid.index({column, row})] = NeuralMap::kDear;
    }
  }
  const auto dear_cells = [&](const std::vector<Cell>& path) {
    return std::count_if(path.begin(), path.end(), [&](const Cell& cell) {
      return map.passable[map.grid.index(cell)] == NeuralMap::kDear;
    });
  };
  NeuralMap landscape = neural_map();
  std::vector<Cell> path;

  landscape.evolve(map.grid, map.passable, {{20, 15}});
  ASSERT_TRUE(landscape.path({0, 15}, path));
  EXPECT_EQ(dear_cells(path), 0);

  // Closed above and below, it is crossed straight.
  for (std::int32_t row = 0; row < 31; ++row) {
    for (std::int32_t column = 9; column <= 11 && (row < 10 || row > 20); ++column) {
      map.passable[map.grid.index({column, row})] = NeuralMap::kBlocked;
    }
  }
  landscape.evolve(map.grid, map.passable, {{20, 15}});
  ASSERT_TRUE(landscape.path({0, 15}, path));
  EXPECT_EQ(dear_cells(path), 3);
}

TEST(NeuralMap, ComesToTheSameLandscapeByRastersAsByParallelUpdates) {
  for (const Lattice lattice : kLattices) {
    RandomMap map = random_map(7, 37, 31, 0.2, 2);
    const Cell target{18, 15};
    map.passable[map.grid.index(target)] = 1;
    NeuralMap landscape = neural_map(lattice);

    landscape.evolve(map.grid, map.passable, {target});

    const std::vector<long double> expected = reference(map, lattice, target, 0.1);
    for (std::size_t i = 0; i < map.grid.size(); ++i) {
      const double found = landscape.log_activation(map.grid.cell(i));
      if (expected[i] == 0.0L) {
        EXPECT_EQ(found, -std::numeric_limits<double>::infinity()) << i;
        continue;
      }
      // An error of 1e-12 in the logarithm is that error of the activation, relative to it.
      EXPECT_NEAR(found, static_cast<double>(std::log(expected[i])), 1e-12 * 200.0) << i;
    }
  }
}

TEST(NeuralMap, LeadsToTheTargetFromEverywhereWhenItStopsEarly) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    RandomMap map = random_map(seed, 150, 90, 0.25, 4);
    const Cell target{2, 3};
    const Cell start{147, 85};
    map.passable[map.grid.index(target)] = map.passable[map.grid.index(start)] = 1;
    const bool has_way = connected(map, Lattice::kEightNeighbours, target)[map.grid.index(start)];
    NeuralMap landscape = neural_map();

    landscape.evolve(map.grid, map.passable, {target}, start);

    std::vector<Cell> path;
    ASSERT_EQ(landscape.path(start, path), has_way) << seed;
    if (!has_way) continue;
    EXPECT_TRUE(path.front() == start && path.back() == target) << seed;
    for (std::size_t i = 1; i < path.size(); ++i) {
      ASSERT_TRUE(landscape.above(path[i], path[i - 1]));
    }
  }
}

TEST(NeuralMap, LeadsToTheNearestOfSeveralTargets) {
  const RandomMap map = random_map(1, 60, 1, 0.0, 0);
  NeuralMap landscape = neural_map();

  landscape.evolve(map.grid, map.passable, {{5, 0}, {50, 0}, {-1, 0}, {60, 0}});

  std::vector<Cell> path;
  ASSERT_TRUE(landscape.path({20, 0}, path));  // 15 cells from one, 30 from the other
  EXPECT_EQ(path.size(), 16u);
  ASSERT_TRUE(landscape.path({40, 0}, path));
  EXPECT_EQ(path.size(), 11u);
}

TEST(NeuralMap, HasNoActivationWithoutAnOpenTarget) {
  RandomMap map = random_map(1, 20, 20, 0.0, 0);
  map.passable[map.grid.index({4, 4})] = 0;
  NeuralMap landscape = neural_map();

  const NeuralMap::Evolution evolution = landscape.evolve(map.grid, map.passable, {{4, 4}});

  EXPECT_TRUE(evolution.at_rest);
  std::vector<Cell> path;
  EXPECT_FALSE(landscape.path({5, 5}, path));
  EXPECT_EQ(landscape.log_activation({5, 5}), -std::numeric_limits<double>::infinity());
}

TEST(NeuralMap, FallsForEverAlongALongCorridor) {
  // 100 corridors of 200 cells: the far end is at about 10^-20000, 60 times beyond a double.
  const RandomMap map = serpentine(199, 200);
  const Cell target{0, 0};
  NeuralMap landscape = neural_map(Lattice::kFourNeighbours);

  landscape.evolve(map.grid, map.passable, {target});

  expect_ways_to(landscape, map, target);
  EXPECT_LT(landscape.log_activation({198, 0}), -20000.0 * std::log(10.0));
}

TEST(NeuralMap, HasNothingFlatOnALargeMap) {
  const std::int32_t side = std::getenv("CLEW_SOAK") != nullptr ? 16384 : 1024;
  RandomMap map = random_map(3, side, side, 0.1, 0);
  const Cell target{1, 2};
  const Cell start{side - 2, side - 3};
  map.passable[map.grid.index(target)] = map.passable[map.grid.index(start)] = 1;
  NeuralMap landscape = neural_map();

  landscape.evolve(map.grid, map.passable, {target}, start);

  expect_ways_to(landscape, map, target);
}

TEST(NeuralMap, IsTheSameOnAGridUsedBefore) {
  const RandomMap large = random_map(1, 90, 80, 0.2, 2);
  const RandomMap small = random_map(2, 50, 40, 0.1, 1);
  NeuralMap used = neural_map();
  NeuralMap fresh = neural_map();
  used.evolve(large.grid, large.passable, {{3, 3}});

  used.evolve(small.grid, small.passable, {{20, 20}});
  fresh.evolve(small.grid, small.passable, {{20, 20}});

  for (std::size_t i = 0; i < small.grid.size(); ++i) {
    const Cell cell = small.grid.cell(i);
    EXPECT_EQ(used.log_activation(cell), fresh.log_activation(cell));
  }
}

TEST(NeuralMap, RefusesAGainThatIsNotStable) {
  // Row sums of the weights 1 / distance: 4 + 4 / sqrt(2), 4 and 6.
  EXPECT_NEAR(eigenvalue_bound(Lattice::kEightNeighbours), 4.0 + 4.0 / std::sqrt(2.0), 1e-12);
  EXPECT_EQ(eigenvalue_bound(Lattice::kFourNeighbours), 4.0);
  EXPECT_EQ(eigenvalue_bound(Lattice::kHexagonal), 6.0);
  for (const Lattice lattice : kLattices) {
    const double limit = 1.0 / eigenvalue_bound(lattice);

    EXPECT_TRUE(NeuralMap::create({lattice, 0.999 * limit}).ok());
    EXPECT_FALSE(NeuralMap::create({lattice, limit}).ok());
    EXPECT_FALSE(NeuralMap::create({lattice, 0.0}).ok());
    EXPECT_FALSE(NeuralMap::create({lattice, std::nan("")}).ok());
  }
  EXPECT_EQ(NeuralMap::create({Lattice::kFourNeighbours, 0.3}).error().message,
            "gain is 0.300000; allowed: from 0.001000, and below 0.250000, where the neural map on "
            "this lattice would not come to rest");
}

TEST(Lattice, LaysItsCellsOneCellApart) {
  const Grid grid{{-1.0, 2.0}, 0.5, 12, 13};
  for (const Lattice lattice : kLattices) {
    const Grid laid = laid_out(lattice, grid);
    // Rows of a hexagonal lattice are 0.866 cells apart: 15 fit into the height of 13.
    EXPECT_EQ(laid.rows, lattice == Lattice::kHexagonal ? 15 : 13);
    for (std::size_t i = 0; i < laid.size(); ++i) {
      const Cell cell = laid.cell(i);
      const Vec2 middle = centre(lattice, laid, cell);

      EXPECT_TRUE(cell_at(lattice, laid, middle) == cell);
      for (const Cell& other : neighbours(lattice, cell)) {
        const double distance_m = core::length(centre(lattice, laid, other) - middle);
        const bool diagonal = other.row != cell.row && other.column != cell.column;
        const double expected = lattice == Lattice::kEightNeighbours && diagonal ? std::sqrt(2) : 1;
        EXPECT_NEAR(distance_m, 0.5 * expected, 1e-12);
      }
    }
  }
}

TEST(Lattice, LinksBothWays) {
  for (const Lattice lattice : kLattices) {
    for (const Cell cell : {Cell{4, 4}, Cell{4, 5}}) {
      for (const Cell& other : neighbours(lattice, cell)) {
        const Neighbours back = neighbours(lattice, other);
        EXPECT_EQ(std::count(back.begin(), back.end(), cell), 1);
      }
    }
  }
}

}  // namespace
}  // namespace clew::map
