// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/result.hpp"
#include "core/yaml_reader.hpp"
#include "world/world_file.hpp"

namespace clew::world {

/// Reads the list `moving` of a world file: circles, polygons and doors, the latter two as the
/// discs that they are made of.
core::Result<void> read_all_moving(const core::YamlNode& root, WorldFile& world);

}  // namespace clew::world
