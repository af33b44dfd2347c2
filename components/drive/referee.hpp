// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/geometry.hpp"
#include "core/parameters.hpp"
#include "domain/messages.hpp"

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
  core::Vec2 target_world = core::Vec2::Zero();
  double target_radius_m = 0.0;  ///< arrival is within this distance of the target
  std::uint64_t max_ticks = 0;   ///< the run ends undecided at this tick
};

/// Judges how a run goes, from the truth and from what the robot says; moves nothing.
class Referee {
 public:
  explicit Referee(const Mission& mission) : mission_(mission) {}

  /// The outcome at the beginning of `tick`. The first that holds of: a collision, arrival, the
  /// robot's giving up, the last tick.
  domain::Outcome judge(std::uint64_t tick, const core::Pose2& pose_world_robot,
                        std::uint32_t collisions, const domain::Motion& commanded) const;

  /// Writes where the mission wants the robot.
  void announce(domain::Target& target) const;

 private:
  Mission mission_;
};

}  // namespace clew::drive
