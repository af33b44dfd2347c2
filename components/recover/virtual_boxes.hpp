// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "core/archive.hpp"
#include "core/geometry.hpp"
#include "domain/messages.hpp"

namespace clew::recover {

using domain::VirtualObstacle;

/// The way that the robot has come, thinned out, as far back as there is room for.
class Trail {
 public:
  struct Point {
    core::Vec2 position_odom = core::Vec2::Zero();
    double travel_m = 0.0;
  };

  /// Keeps `capacity` points that are `spacing_m` apart.
  Trail(double spacing_m, std::size_t capacity) : spacing_m_(spacing_m), capacity_(capacity) {}

  void add(const core::Vec2& position_odom, double travel_m);

  /// The bounding box of all points since `since_travel_m`; at least of the last one.
  VirtualObstacle bounds(double since_travel_m) const;

  std::deque<Point>& points() { return points_; }
  const std::deque<Point>& points() const { return points_; }

 private:
  double spacing_m_;
  std::size_t capacity_;
  std::deque<Point> points_;  // oldest first
};

template <typename Visitor>
void visit_fields(Visitor& visit, Trail::Point& p) {
  visit(p.position_odom, p.travel_m);
}

/// The same box, at least `least_m` wide and high about the same centre.
VirtualObstacle widened(const VirtualObstacle& box, double least_m);

/// The box without the strip that comes within `clearance_m` of a point: of the four ways to cut,
/// the one that leaves most. Nothing if that is thinner than `least_m`.
std::optional<VirtualObstacle> cut_clear(const VirtualObstacle& box, const core::Vec2& point_odom,
                                         double clearance_m, double least_m);

/// The same box at half its size about its centre; nothing if that is thinner than `least_m`.
std::optional<VirtualObstacle> halved(const VirtualObstacle& box, double least_m);

/// Pin & Bender 1996, figure 3: the point `beyond_m` outside the midpoint of the side of the box
/// that lies opposite a goal. That side is the one through which the line from the goal leaves the
/// box at its centre's far side.
core::Vec2 point_opposite(const VirtualObstacle& box, const core::Vec2& goal_odom, double beyond_m);

}  // namespace clew::recover
