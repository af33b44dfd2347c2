// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "domain/picture.hpp"
#include "world/world.hpp"

namespace clew::plot {

/// Draws the paths of one or several recordings of runs in the same world into one picture. The end
/// of `output` chooses its kind, `.svg`, `.png` or `.pdf`; a file of that name is replaced. The
/// same recordings give the same SVG bytes.
///
/// Refused: another ending, recordings that cannot be read, were made with other message types or
/// hold no state, worlds that differ, and an output that cannot be written. A recording that was
/// cut off is drawn up to the tear, and the picture says so.
core::Result<void> plot_recordings(const std::vector<std::string>& recordings,
                                   const std::string& output);

/// Draws a world without a run: the robot at its start, and a mark at each of the traps. Refused:
/// another ending, and an output that cannot be written.
core::Result<void> plot_world(const world::World& world, double robot_radius_m,
                              const std::vector<core::Vec2>& traps, const std::string& output);

/// What the components of a run showed of a tick.
struct InsideView {
  std::uint64_t tick = 0;
  std::vector<domain::Picture> pictures;
};

/// Draws a tick of a recorded run: the world, the robot and its way up to there, and what its
/// components showed. Refused: as above, and a tick of which the recording has no pose.
core::Result<void> plot_tick(const std::string& recording, const InsideView& inside,
                             const std::string& output);

/// Writes an SVG picture as such, or rendered. Refused: another ending, and an output that cannot
/// be written.
core::Result<void> write_picture(const std::string& svg, const std::string& output);

}  // namespace clew::plot
