// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "plot/map_view.hpp"
#include "plot/svg_writer.hpp"
#include "world/world.hpp"

namespace clew::plot {

/// The length of a scale bar or the grid's step for something `extent_m` wide: 1, 2 or 5 times a
/// power of ten, at most a fifth of it.
double round_length_m(double extent_m);

/// Where robots go: each from way-point to way-point.
using Ways = std::vector<std::vector<world::Waypoint>>;

/// Which moving obstacles are drawn: all, or those that are no other robots.
enum class Moving { kAll, kNoRobots };

/// Draws grid and its metres, obstacles, boundary, and each way with its way-points. Moving
/// obstacles are drawn where they stand at time 0 (dashed) and at `end_time_s`, with their whole
/// way.
void draw_world(SvgWriter& svg, const MapView& view, const world::World& world, const Ways& ways,
                double end_time_s, Moving moving = Moving::kAll);

/// Draws the robot's body as it stands at the start.
void draw_start(SvgWriter& svg, const MapView& view, const core::Pose2& start, double radius_m);

void draw_scale_bar(SvgWriter& svg, const MapView& view, const world::World& world);

}  // namespace clew::plot
