// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry.hpp"
#include "core/result.hpp"
#include "domain/messages.hpp"
#include "run/missions.hpp"

namespace clew::plot {

/// A place of the world where something happened.
struct Mark {
  domain::EventKind kind = domain::EventKind::kLandmark;
  core::Vec2 position = core::Vec2::Zero();
};

/// A trap that a detector reported, and the earlier visit that proves it.
struct TrapMark {
  core::Vec2 position = core::Vec2::Zero();
  std::optional<core::Vec2> earlier;
  bool shadow = false;  ///< by a detector that only watched
};

/// A landmark that a network knew.
struct LandmarkMark {
  core::Vec2 position = core::Vec2::Zero();
  domain::Network network = domain::Network::kSom;
};

/// A virtual target, and where the robot was when it was set.
struct VirtualTargetMark {
  core::Vec2 position = core::Vec2::Zero();
  core::Vec2 from = core::Vec2::Zero();
};

/// Where the odometry's frame lies in the world, as the poses of one tick tell.
struct FramePair {
  core::Pose2 world_robot;
  core::Pose2 odom_robot;

  core::Vec2 to_world(const core::Vec2& place_odom) const;
};

/// What a picture shows of one run. All places are in the world's frame.
struct RunTrack {
  std::string name;   ///< of the file, without folder and ending
  std::string path;   ///< of the file
  std::string world;  ///< the world file's text
  core::Pose2 start;  ///< where that world has the robot begin
  double robot_radius_m = 0.0;
  std::string graph;  ///< its name, detector and escapes, as far as the recording tells
  std::uint64_t seed = 0;
  double tick_s = 0.0;
  bool cut_off = false;  ///< the recording is not whole

  std::vector<bridge::GivenMission> missions;  ///< by tick, the first from the beginning on

  std::uint64_t first_tick = 0;
  std::vector<core::Pose2> poses;  ///< at the start of each tick, from the first to the last
  std::vector<bool> recovering;    ///< in each tick; as many as poses
  domain::State last_state;
  std::map<std::uint64_t, FramePair> frames;  ///< by tick, where there is an odometry

  std::vector<TrapMark> traps;
  std::vector<LandmarkMark> landmarks;
  std::vector<Mark> marks;  ///< reflexes, escapes begun, ended and failed, unreachable
  std::vector<VirtualTargetMark> virtual_targets;
  std::vector<core::Vec2> controller_targets;  ///< that the controller set by itself
  /// Corners of boxes that the controller was to imagine, each box once.
  std::vector<std::array<core::Vec2, 4>> virtual_obstacles;
  /// Where the robot believed to be, if its odometry drifts: as from its true start.
  std::vector<core::Vec2> believed;
  std::vector<core::Vec2> subgoals;  ///< of a plan, each once
  std::vector<core::Vec2> safety_stops;
  std::vector<core::Vec2> collisions;  ///< that the robot moved into
  std::vector<core::Vec2> hits;        ///< by moving obstacles
};

/// Reads the track of a recorded run. Places that were recorded in the odometry's frame are taken
/// to the world by the true and the odometric pose of the same tick, so that drift does not move
/// them off the path. Refused: see plot_recordings.
core::Result<RunTrack> read_run_track(const std::string& path);

}  // namespace clew::plot
