// SPDX-License-Identifier: Apache-2.0
#include "control/polar/scan_memory.hpp"

#include <cmath>

namespace clew::control {
namespace {

constexpr double kJump_m = 0.3;

/// Whether a ray stands alone: no ray beside it meets anything near to what it meets.
bool stands_alone(const domain::Scan& scan, std::size_t i) {
  if (scan.beam_width_rad > 0.0) return false;
  const auto near = [&](std::size_t other) {
    return std::fabs(scan.ranges_m[other] - scan.ranges_m[i]) <= kJump_m;
  };
  return !(i > 0 && near(i - 1)) && !(i + 1 < scan.ranges_m.size() && near(i + 1));
}

}  // namespace

ScanMemory::ScanMemory(std::size_t scans, std::size_t beams, double radius_m)
    : radius_m_(radius_m) {
  state_.scans.resize(scans);
  for (Kept& kept : state_.scans) kept.returns_robot.reserve(beams);
}

void ScanMemory::add(const core::Pose2& pose_odom_robot, const domain::Scan& scan) {
  state_.newest = (state_.newest + 1) % state_.scans.size();
  Kept& kept = state_.scans[state_.newest];
  kept.pose_odom_robot = pose_odom_robot;
  kept.returns_robot.clear();
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (scan.ranges_m[i] >= scan.range_max_m || stands_alone(scan, i)) continue;
    kept.returns_robot.push_back((radius_m_ + scan.ranges_m[i]) *
                                 core::direction(scan.bearing_rad(i)));
  }
}

void ScanMemory::forget() {
  for (Kept& kept : state_.scans) kept.returns_robot.clear();
}

void ScanMemory::returns_seen_from(const core::Pose2& pose_odom, double scope_m,
                                   std::vector<core::Vec2>& returns) const {
  returns.clear();
  const std::size_t count = state_.scans.size();
  for (std::size_t i = 0; i < count; ++i) {
    add_seen_from(pose_odom, state_.scans[(state_.newest + count - i) % count], scope_m, returns);
  }
}

void ScanMemory::newest_seen_from(const core::Pose2& pose_odom, double scope_m,
                                  std::vector<core::Vec2>& returns) const {
  returns.clear();
  add_seen_from(pose_odom, state_.scans[state_.newest], scope_m, returns);
}

void ScanMemory::add_seen_from(const core::Pose2& pose_odom, const Kept& kept, double scope_m,
                               std::vector<core::Vec2>& returns) const {
  const core::Vec2 ahead = core::direction(pose_odom.heading_rad);
  const core::Vec2 kept_ahead = core::direction(kept.pose_odom_robot.heading_rad);
  const core::Vec2 moved = kept.pose_odom_robot.position() - pose_odom.position();
  // Both rotations in one: cosine and sine of the difference of the headings.
  const double c = ahead.x() * kept_ahead.x() + ahead.y() * kept_ahead.y();
  const double s = ahead.x() * kept_ahead.y() - ahead.y() * kept_ahead.x();
  const core::Vec2 offset(ahead.x() * moved.x() + ahead.y() * moved.y(),
                          ahead.x() * moved.y() - ahead.y() * moved.x());
  for (const core::Vec2& place : kept.returns_robot) {
    const core::Vec2 seen(offset.x() + c * place.x() - s * place.y(),
                          offset.y() + s * place.x() + c * place.y());
    const double distance_m = core::length(seen);
    if (distance_m >= radius_m_ && distance_m <= scope_m) returns.push_back(seen);
  }
}

}  // namespace clew::control
