// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "map/grid.hpp"

namespace clew::map {

/// Whether all cells that the straight line between two places runs through are passable
/// (Amanatides & Woo 1987, "A fast voxel traversal algorithm"), those at both ends excepted. False
/// if one of the places is outside the grid.
///
/// passable: one flag a cell of the grid, 0 for blocked.
bool line_of_sight(const Grid& grid, const std::vector<std::uint8_t>& passable, const Vec2& from,
                   const Vec2& to);

}  // namespace clew::map
