// SPDX-License-Identifier: Apache-2.0
#include "world/route.hpp"

#include <cmath>
#include <utility>

#include "core/angle.hpp"
#include "core/check.hpp"

namespace clew::world {
namespace {

core::Hash128 digest_of(const std::vector<Waypoint>& waypoints) {
  core::StateWriter bytes;
  for (const Waypoint& waypoint : waypoints) {
    bytes(waypoint.place, waypoint.radius_m);
    if (!waypoint.heading) continue;
    bytes(waypoint.heading->heading_rad, waypoint.heading->tolerance_rad);
  }
  return core::hash128(bytes.bytes());
}

}  // namespace

bool GoalHeading::is_met_by(double robot_heading_rad) const {
  return std::fabs(core::wrap_angle_rad(robot_heading_rad - heading_rad)) <= tolerance_rad;
}

bool Waypoint::is_reached_by(const Pose2& robot) const {
  return core::distance_m(robot, place) <= radius_m &&
         (!heading || heading->is_met_by(robot.heading_rad));
}

Route::Route(std::vector<Waypoint> waypoints)
    : waypoints_(std::move(waypoints)), digest_(digest_of(waypoints_)) {}

void Route::pass(const core::Pose2& robot) {
  while (next_ + 1 < waypoints_.size() && waypoints_[next_].is_reached_by(robot)) ++next_;
}

bool Route::ends_at(const core::Pose2& robot) const {
  return next_ + 1 == waypoints_.size() && waypoints_.back().is_reached_by(robot);
}

const Waypoint& Route::next() const {
  CLEW_CHECK(next_ < waypoints_.size(), "an empty route leads nowhere");
  return waypoints_[next_];
}

void Route::save(core::StateWriter& writer) const {
  if (next_ > 0) writer(digest_, next_);
}

void Route::load(core::StateReader& reader) {
  next_ = 0;
  if (reader.complete()) return;
  core::Hash128 digest;
  std::uint32_t next = 0;
  reader(digest, next);
  const bool is_ours = digest == digest_;
  const bool valid = !is_ours || next < waypoints_.size();
  if (!reader.check(valid, "'next' is no way-point of the mission")) return;
  next_ = is_ours ? next : 0;
}

}  // namespace clew::world
