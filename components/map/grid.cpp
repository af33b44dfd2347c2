// SPDX-License-Identifier: Apache-2.0
#include "map/grid.hpp"

#include <cmath>

namespace clew::map {

std::optional<Cell> Grid::cell_at(const Vec2& place) const {
  const Vec2 steps = (place - corner) / cell_m;
  if (!(steps.x() >= 0.0 && steps.y() >= 0.0 && steps.x() < columns && steps.y() < rows)) {
    return std::nullopt;
  }
  return Cell{static_cast<std::int32_t>(std::floor(steps.x())),
              static_cast<std::int32_t>(std::floor(steps.y()))};
}

}  // namespace clew::map
