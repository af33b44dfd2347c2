// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "core/result.hpp"
#include "domain/messages.hpp"
#include "recording/run_recording.hpp"
#include "world/route.hpp"

namespace clew::tools {

/// A way-point that the robot has reached.
struct WaypointMark {
  std::uint64_t tick = 0;
  double time_s = 0.0;
  core::Vec2 place = core::Vec2::Zero();  ///< of the robot then, in truth
  std::size_t number = 0;                 ///< from 1
  std::size_t of = 0;                     ///< way-points of the mission
};

/// Judges again, from what a recording holds, which way-points were reached, as drive's referee did
/// by odometry: each mission of the run from the tick at which it was given. A mission of one place
/// has no marks: the outcome says all of it. What was reached before a black box begins is not
/// known, so a mission that goes on there has none either.
class WaypointMarks {
 public:
  /// Refused: a recording whose world, graph or goals cannot be read.
  static core::Result<WaypointMarks> create(const bridge::RunRecording& recording);

  /// Whether there is a mission of several way-points.
  bool any() const;
  /// Where the robot believes to be, in the tick of the next state.
  void hear(const domain::Odometry& odometry) { believed_ = odometry.pose_odom_robot; }
  /// Those that were reached at the state's tick; states in their order. Without odometry, by the
  /// truth.
  std::vector<WaypointMark> see(const domain::State& state);

 private:
  struct Mission {
    std::uint64_t tick;
    world::Route route;
  };

  std::optional<core::Pose2> believed_;
  std::deque<Mission> missions_;  ///< by tick, the one in force first
};

/// As commands print them with --json.
nlohmann::ordered_json waypoints_json(const std::vector<WaypointMark>& marks);

/// All marks of a recording.
core::Result<std::vector<WaypointMark>> waypoint_marks(const bridge::RunRecording& recording);

}  // namespace clew::tools
