// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "control/infrared/four_infrareds.hpp"
#include "control/infrared/wheel_speeds.hpp"

namespace clew::control {

struct TargetTermParameters {
  bool enabled = true;
  double speed_mps = 0.3;
  double turn_mps = 0.2;
  double free_m = 0.5;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, TargetTermParameters& p) {
  visit.flag("target_term", p.enabled,
             "true: it seeks the target; false: it only avoids obstacles");
  visit.number("target_speed_mps", p.speed_mps, "m/s", {0.0, 2.0},
               "speed of both wheels if the target is straight ahead and the path is free");
  visit.number(
      "target_turn_mps", p.turn_mps, "m/s", {0.0, 2.0},
      "speed of the wheels against each other if the target is at a side and that side is free");
  visit.number("target_free_m", p.free_m, "m", {0.11, 5.0},
               "a side is free if its reading is at least this");
}

/// What makes a controller that only avoids obstacles go for a target: wheel speeds to be added to
/// its own. *Ours:* Wang, Yang & Meng's robot has no target. With b the target's bearing, positive
/// on the left, and f = (d - 0.1) / (free - 0.1), clipped to 0..1, how free a side is,
///
///     V_L, V_R += speed f_ahead max(0, cos b) -+ turn f_ahead f_beside clip(b / 90 deg, -1, 1)
///
/// where beside is the side of the target. So near an obstacle the controller's own rules decide;
/// past it, with that side free again, the robot turns back to the target.
WheelSpeeds target_term(const TargetTermParameters& parameters, double target_bearing_rad,
                        const InfraredDistances& distances_m);

}  // namespace clew::control
