// SPDX-License-Identifier: Apache-2.0
#include "drive/referee.hpp"

namespace clew::drive {

using domain::Outcome;

Outcome Referee::judge(std::uint64_t tick, const core::Pose2& pose_world_robot,
                       std::uint32_t collisions, const domain::Motion& commanded) {
  if (collisions > 0) return Outcome::kCollided;
  route_.pass(pose_world_robot);
  if (route_.ends_at(pose_world_robot)) return Outcome::kReached;
  if (commanded.kind == domain::CommandKind::kGiveUp && !waits()) return Outcome::kUnreachable;
  return tick >= max_ticks_ ? Outcome::kTimeout : Outcome::kRunning;
}

void Referee::announce(const core::Pose2& pose_odom_robot, domain::Target& target) const {
  const core::Vec2 place = waits() ? pose_odom_robot.position() : route_.next().place;
  target.x_m = place.x();
  target.y_m = place.y();
  target.radius_m = waits() ? 0.0 : route_.next().radius_m;
}

}  // namespace clew::drive
