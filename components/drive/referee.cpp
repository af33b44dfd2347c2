// SPDX-License-Identifier: Apache-2.0
#include "drive/referee.hpp"

namespace clew::drive {

using domain::Outcome;

Outcome Referee::judge(std::uint64_t tick, const core::Pose2& pose_world_robot,
                       std::uint32_t collisions, const domain::Motion& commanded) const {
  if (collisions > 0) return Outcome::kCollided;
  if (core::distance_m(pose_world_robot, mission_.target_world) <= mission_.target_radius_m) {
    return Outcome::kReached;
  }
  if (commanded.kind == domain::CommandKind::kGiveUp) return Outcome::kUnreachable;
  return tick >= mission_.max_ticks ? Outcome::kTimeout : Outcome::kRunning;
}

void Referee::announce(domain::Target& target) const {
  target.x_m = mission_.target_world.x();
  target.y_m = mission_.target_world.y();
  target.radius_m = mission_.target_radius_m;
}

}  // namespace clew::drive
