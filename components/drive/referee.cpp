// SPDX-License-Identifier: Apache-2.0
#include "drive/referee.hpp"

namespace clew::drive {

using domain::Outcome;

Outcome Referee::judge(std::uint64_t tick, const Place& place, std::uint32_t collisions,
                       const domain::Motion& commanded) {
  if (collisions > 0) return Outcome::kCollided;
  route_.pass(place.pose_odom_robot);
  if (route_.ends_at(place.pose_world_robot)) return Outcome::kReached;
  if (commanded.kind == domain::CommandKind::kGiveUp && !waits()) return Outcome::kUnreachable;
  return tick >= max_ticks_ ? Outcome::kTimeout : Outcome::kRunning;
}

void Referee::announce(const core::Pose2& pose_odom_robot, domain::Target& target) const {
  const domain::TickStamp stamp = target.stamp;
  target = {};
  target.stamp = stamp;
  if (waits()) {
    target.x_m = pose_odom_robot.x_m;
    target.y_m = pose_odom_robot.y_m;
    return;
  }
  const world::Waypoint& next = route_.next();
  target.x_m = next.place.x();
  target.y_m = next.place.y();
  target.radius_m = next.radius_m;
  target.waypoint = static_cast<std::uint32_t>(route_.passed() + 1);
  target.waypoints = static_cast<std::uint32_t>(route_.size());
  if (!next.heading) return;
  target.has_heading = true;
  target.heading_rad = next.heading->heading_rad;
  target.heading_tolerance_rad = next.heading->tolerance_rad;
}

}  // namespace clew::drive
