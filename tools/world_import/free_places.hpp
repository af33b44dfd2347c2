// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

#include "world_import/cell_world.hpp"

namespace clew::world_import {

/// Two places for a disc of `radius_m` that are far apart on the largest connected free area: the
/// last cell that a breadth-first sweep of it reaches, and the last one of a sweep from there.
/// None if no cell has room for it.
std::optional<std::pair<Vec2, Vec2>> far_places(const CellMap& map, bool unknown_is_blocked,
                                                double radius_m);

}  // namespace clew::world_import
