// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plot/run_track.hpp"
#include "world/world.hpp"

namespace clew::plot {

/// The picture of runs in a world, as an SVG file's text: title with the outcome, map, scale bar
/// and a legend of what is in it. At least one track.
std::string draw_runs(const world::World& world, const std::vector<RunTrack>& tracks);

}  // namespace clew::plot
