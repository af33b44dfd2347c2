// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>

#include "core/archive.hpp"
#include "core/geometry.hpp"
#include "domain/messages.hpp"

namespace clew::recover {

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
  domain::VirtualObstacle bounds(double since_travel_m) const;

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

}  // namespace clew::recover
