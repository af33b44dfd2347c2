// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/result.hpp"
#include "core/yaml_reader.hpp"
#include "world/world.hpp"

namespace clew::world {

/// Reads the list `moving` of a world file: circles, polygons and doors, the latter two as the
/// discs that they are made of.
core::Result<void> read_all_moving(const core::YamlNode& root, std::vector<MovingObstacle>& moving);

}  // namespace clew::world
