// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/archive.hpp"
#include "core/geometry.hpp"
#include "core/parameters.hpp"
#include "domain/messages.hpp"
#include "world/route.hpp"

namespace clew::drive {

struct ArrivalParameters {
  double arrive_m = 0.0;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, ArrivalParameters& p) {
  visit.number("arrive_m", p.arrive_m, "m", {0.0, 10.0},
               "arrival is within this distance of the target; 0: the world's target radius");
}

/// What a robot is sent out for.
struct Mission {
  std::vector<world::Waypoint> waypoints;  ///< in their order; none: the robot waits where it is
  std::uint64_t max_ticks = 0;             ///< the run ends undecided at this tick
};

/// Judges how a run goes, from the truth and from what the robot says; moves nothing.
class Referee {
 public:
  explicit Referee(const Mission& mission)
      : route_(mission.waypoints), max_ticks_(mission.max_ticks) {}

  /// Whether the robot has nowhere to go: what it is commanded does not count then.
  bool waits() const { return route_.empty(); }

  /// Where a robot is, in truth, and by what it knows itself.
  struct Place {
    core::Pose2 pose_world_robot;
    core::Pose2 pose_odom_robot;
  };

  /// The outcome at the beginning of `tick`. The first that holds of: a collision, arrival at the
  /// last way-point, the robot's giving up, the last tick. Arrival is a matter of the truth. The
  /// way-points before are the robot's own affair: it passes one where it believes to be there, as
  /// *plan* does, and any robot that is not simulated.
  domain::Outcome judge(std::uint64_t tick, const Place& place, std::uint32_t collisions,
                        const domain::Motion& commanded);

  /// Writes where the mission wants the robot: at the next way-point, or where it believes it is.
  void announce(const core::Pose2& pose_odom_robot, domain::Target& target) const;

  const world::Route& route() const { return route_; }

  void save(core::StateWriter& writer) const { route_.save(writer); }
  void load(core::StateReader& reader) { route_.load(reader); }

 private:
  world::Route route_;
  std::uint64_t max_ticks_;
};

}  // namespace clew::drive
