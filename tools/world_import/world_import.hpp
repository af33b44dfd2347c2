// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/geometry.hpp"
#include "core/result.hpp"

namespace clew::world_import {

struct ImportOptions {
  std::optional<core::Pose2> start;  ///< none: the file's, or a place that is found
  std::optional<core::Vec2> target;  ///< the same
  std::optional<double> target_radius_m;
  std::optional<double> cell_m;  ///< of pictures (0.05) and MovingAI maps (0.5), which do not tell
  bool unknown_is_blocked = true;
  std::optional<std::size_t> scenario;  ///< line of a .scen file; none: the last
  double robot_radius_m = 0.15;         ///< for which start and target are sought
};

/// Reads somebody else's world by its file's name: `.yaml` a map of ROS, `.world` and `.sdf`
/// Gazebo, as BARN's worlds, `.map` and `.scen` MovingAI, `.pgm` and `.png` pictures. Returns a
/// world file's text, checked. Refused: what the formats' readers refuse, and a world in which the
/// robot finds no place.
core::Result<std::string> import_world(const std::string& source, const ImportOptions& options);

}  // namespace clew::world_import
