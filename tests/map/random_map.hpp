// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "map/grid.hpp"

namespace clew::map {

/// A grid of unit cells, and which of them are passable.
struct RandomMap {
  Grid grid;
  std::vector<std::uint8_t> passable;
};

/// Scattered blocked cells and straight walls with gaps, the same for the same seed.
RandomMap random_map(std::uint64_t seed, std::int32_t columns, std::int32_t rows,
                     double blocked_ratio, int walls);

/// A corridor one cell wide that goes up and down through the whole map, from the lower left.
RandomMap serpentine(std::int32_t columns, std::int32_t rows);

}  // namespace clew::map
