// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "map/costmap.hpp"

namespace clew::map {

/// Appends to `corners` the place `from` and those of a path between which going straight costs no
/// more than the path does; its last place is the last of them.
///
/// path: of at least one place, the first in the cell of `from`; from cell to neighbouring cell, as
/// a search finds it. All places lie within the grid.
void pull_tight(const Costmap& costs, const std::vector<Vec2>& path, const Vec2& from,
                std::vector<Vec2>& corners);

}  // namespace clew::map
