// SPDX-License-Identifier: Apache-2.0
#include "random_map.hpp"

#include "core/random.hpp"

namespace clew::map {

RandomMap random_map(std::uint64_t seed, std::int32_t columns, std::int32_t rows,
                     double blocked_ratio, int walls) {
  RandomMap map{{{0.0, 0.0}, 1.0, columns, rows}, {}};
  const core::Random random({seed, 0, 0, 0});
  std::uint32_t drawn = 0;
  for (std::size_t i = 0; i < map.grid.size(); ++i) {
    map.passable.push_back(random.uniform(drawn++) < blocked_ratio ? 0 : 1);
  }
  for (int wall = 0; wall < walls; ++wall) {
    const bool upright = random.uniform(drawn++) < 0.5;
    const std::int32_t length = upright ? rows : columns;
    const std::int32_t across = upright ? columns : rows;
    const auto at = static_cast<std::int32_t>(random.uniform(drawn++) * across);
    const auto gap = static_cast<std::int32_t>(random.uniform(drawn++) * length);
    for (std::int32_t i = 0; i < length; ++i) {
      if (i == gap) continue;
      map.passable[map.grid.index(upright ? Cell{at, i} : Cell{i, at})] = 0;
    }
  }
  return map;
}

RandomMap serpentine(std::int32_t columns, std::int32_t rows) {
  RandomMap map{{{0.0, 0.0}, 1.0, columns, rows}, {}};
  map.passable.assign(map.grid.size(), 1);
  for (std::int32_t column = 1; column < columns; column += 2) {
    const std::int32_t gap = column % 4 == 1 ? rows - 1 : 0;
    for (std::int32_t row = 0; row < rows; ++row) {
      if (row != gap) map.passable[map.grid.index({column, row})] = 0;
    }
  }
  return map;
}

}  // namespace clew::map
