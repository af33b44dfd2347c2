// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plot/plot.hpp"
#include "plot/run_track.hpp"
#include "world/world.hpp"

namespace clew::plot {

/// The picture of a tick, as an SVG file's text: the map with the layers that components showed,
/// the way up to there and the robot; a legend of the layers; the charts. The track has a pose of
/// the tick.
std::string draw_tick(const world::World& world, const RunTrack& track, const InsideView& inside);

}  // namespace clew::plot
