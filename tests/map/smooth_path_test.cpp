// SPDX-License-Identifier: Apache-2.0
#include "map/smooth_path.hpp"

#include <gtest/gtest.h>

#include "random_map.hpp"

namespace clew::map {
namespace {

double length_of(const std::vector<Vec2>& places) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    length_m += core::length(places[i] - places[i - 1]);
  }
  return length_m;
}

TEST(SmoothPath, IsAlmostStraightInTheOpen) {
  const RandomMap map = random_map(1, 120, 60, 0.0, 0);
  for (const Lattice lattice : {Lattice::kEightNeighbours, Lattice::kHexagonal}) {
    NeuralMap landscape = NeuralMap::create({lattice, 0.1}).value();
    const Grid laid = laid_out(lattice, map.grid);
    landscape.evolve(laid, std::vector<std::uint8_t>(laid.size(), 1), {{100, 40}});
    std::vector<Vec2> places;

    ASSERT_TRUE(smooth_path(landscape, {10, 10}, places));

    // Over cells it would be octile or hexagonal, 1.04 times the straight way and more.
    const double straight_m = core::length(places.back() - places.front());
    EXPECT_LT(length_of(places), 1.01 * straight_m);
    EXPECT_EQ(places.front(), centre(lattice, landscape.grid(), {10, 10}));
    EXPECT_EQ(places.back(), centre(lattice, landscape.grid(), {100, 40}));
  }
}

TEST(SmoothPath, StaysOnActiveCellsAndEndsAtTheTarget) {
  for (std::uint64_t seed = 0; seed < 15; ++seed) {
    RandomMap map = random_map(seed, 70, 50, 0.013 * static_cast<double>(seed), 2);
    const Cell target{60, 40};
    map.passable[map.grid.index(target)] = 1;
    NeuralMap landscape = NeuralMap::create({}).value();
    landscape.evolve(map.grid, map.passable, {target});
    for (std::size_t i = 0; i < map.grid.size(); i += 97) {
      std::vector<Vec2> places;

      const bool found = smooth_path(landscape, map.grid.cell(i), places);

      ASSERT_EQ(found, landscape.active(map.grid.cell(i)));
      if (!found) continue;
      EXPECT_EQ(places.back(), map.grid.centre(target));
      for (std::size_t k = 0; k < places.size(); ++k) {
        ASSERT_TRUE(landscape.active(*map.grid.cell_at(places[k]))) << seed;
        // No step is longer than one between the centres of neighbours, from a cell's corner.
        if (k == 0) continue;
        ASSERT_LE(core::length(places[k] - places[k - 1]), 2.13);
      }
    }
  }
}

}  // namespace
}  // namespace clew::map
