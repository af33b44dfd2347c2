// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/archive.hpp"
#include "core/geometry.hpp"
#include "core/hash128.hpp"
#include "world/world.hpp"

namespace clew::world {

/// How far a robot has come on the way-points of its mission.
class Route {
 public:
  /// `waypoints` in their order; none: there is nowhere to go to.
  explicit Route(std::vector<Waypoint> waypoints);

  /// Passes the way-points that the robot has reached, all but the last, which ends the mission.
  void pass(const core::Pose2& robot);
  /// Whether the robot is at the last one, and has passed all before it.
  bool ends_at(const core::Pose2& robot) const;

  bool empty() const { return waypoints_.empty(); }
  std::size_t size() const { return waypoints_.size(); }
  /// How many were passed: the index of the next.
  std::size_t passed() const { return next_; }
  /// Where to go now. Not to be asked of an empty route.
  const Waypoint& next() const;

  /// As the last of a state: where nothing was passed yet nothing is written, as before there were
  /// way-points.
  void save(core::StateWriter& writer) const;
  /// A state of another route is that of a robot whose mission was replaced: this one begins.
  void load(core::StateReader& reader);

 private:
  std::vector<Waypoint> waypoints_;
  core::Hash128 digest_;  ///< of the way-points
  std::uint32_t next_ = 0;
};

}  // namespace clew::world
