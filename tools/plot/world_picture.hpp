// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "world/world.hpp"

namespace clew::plot {

/// The picture of a world before any run, as an SVG file's text: name, what it is about, map with
/// the robot at the start, scale bar. Moving obstacles are drawn as draw_world does it, with the
/// end of their paths as the end. `traps` are marked.
std::string draw_empty_world(const world::World& world, double robot_radius_m,
                             const std::vector<core::Vec2>& traps = {});

}  // namespace clew::plot
