// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "world/world.hpp"

namespace clew::train {

/// A world file like `world`, with every length multiplied by `scale`, except the radius of the
/// target. What moves is left out.
std::string scaled_world_yaml(const world::World& world, double scale);

}  // namespace clew::train
