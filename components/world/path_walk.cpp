// SPDX-License-Identifier: Apache-2.0
#include "world/path_walk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clew::world {

PathWalk::PathWalk(const MovingObstacle& obstacle, double time_s)
    : obstacle_(obstacle), wraps_(obstacle.loop && obstacle.path.size() > 1) {
  const auto& path = obstacle.path;
  if (wraps_) offset_s_ = path.back().time_s * std::floor(time_s / path.back().time_s);
  const auto next =
      std::upper_bound(path.begin() + 1, path.end(), time_s - offset_s_,
                       [](double time, const auto& waypoint) { return time < waypoint.time_s; });
  leg_ = static_cast<std::size_t>(next - path.begin()) - 1;
  if (wraps_ && next == path.end()) {
    leg_ = path.size() - 2;
    advance();
  }
}

double PathWalk::leg_end_s() const {
  const auto& path = obstacle_.path;
  return leg_ + 1 < path.size() ? offset_s_ + path[leg_ + 1].time_s
                                : std::numeric_limits<double>::infinity();
}

Vec2 PathWalk::position_at(double time_s) const {
  const auto& path = obstacle_.path;
  const MovingObstacle::Waypoint& a = path[leg_];
  if (leg_ + 1 == path.size()) return a.position;
  const MovingObstacle::Waypoint& b = path[leg_ + 1];
  const double fraction = (time_s - offset_s_ - a.time_s) / (b.time_s - a.time_s);
  const double u = std::min(std::max(fraction, 0.0), 1.0);
  return {a.position.x() + u * (b.position.x() - a.position.x()),
          a.position.y() + u * (b.position.y() - a.position.y())};
}

void PathWalk::advance() {
  ++leg_;
  if (wraps_ && leg_ + 1 == obstacle_.path.size()) {
    leg_ = 0;
    offset_s_ += obstacle_.path.back().time_s;
  }
}

std::size_t point_after(const MovingObstacle& obstacle, double time_s) {
  const auto& path = obstacle.path;
  const auto next = std::upper_bound(
      path.begin() + 1, path.end(), time_s,
      [](double time, const MovingObstacle::Waypoint& waypoint) { return time < waypoint.time_s; });
  return static_cast<std::size_t>(next - path.begin()) - 1;
}

Vec2 MovingObstacle::position_at(double time_s) const {
  if (jumps) return path[point_after(*this, time_s - kJumpTolerance_s)].position;
  return PathWalk(*this, time_s).position_at(time_s);
}

}  // namespace clew::world
