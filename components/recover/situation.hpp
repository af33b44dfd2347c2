// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/geometry.hpp"
#include "domain/messages.hpp"
#include "map/local_path.hpp"

namespace clew::recover {

/// What detectors and escapes see of a tick.
struct Situation {
  std::uint64_t tick = 0;
  const domain::Odometry& odometry;
  const domain::Scan& scan;
  const domain::Landmark* landmark = nullptr;  ///< null if no vector was presented
  core::Vec2 target_odom;                      ///< the mission's
  core::Vec2 pursued_odom;       ///< the active target in the tick before: an escape's own, or that
  double target_radius_m = 0.0;  ///< arrival within this distance of the mission's
  /// All that was seen, this tick included; null if no behaviour reads_local_map().
  const map::LocalMap* local_map = nullptr;
  map::PathFinders* path_finders = nullptr;  ///< over that map

  const core::Pose2& pose() const { return odometry.pose_odom_robot; }
  double target_bearing_rad() const { return core::bearing_rad(pose(), target_odom); }
  double target_distance_m() const { return core::distance_m(pose(), target_odom); }
  /// The same with another scan, as of fewer beams, and without a map.
  Situation with(const domain::Scan& other) const {
    return {tick, odometry, other, landmark, target_odom, pursued_odom, target_radius_m};
  }
  /// The path to the mission's target over what was seen; with a local map only.
  map::PathRequest path_request() const {
    return {tick, pose().position(), target_odom, target_radius_m, *local_map, path_finders};
  }
};

}  // namespace clew::recover
