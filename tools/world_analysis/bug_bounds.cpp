// SPDX-License-Identifier: Apache-2.0
#include "world_analysis/bug_bounds.hpp"

#include <algorithm>
#include <limits>

#include "core/segment.hpp"
#include "world_analysis/boundary_curves.hpp"

namespace clew::world_analysis {
namespace {

double distance_m(const BoundaryCurve& curve, const Vec2& point) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const Vec2& next = curve.points[(i + 1) % curve.points.size()];
    least_m = std::min(least_m, core::distance_to_segment_m(curve.points[i], next, point));
  }
  return least_m;
}

/// How often a curve crosses the straight line between two places. A point on the line counts as
/// left of it, so that a curve through it crosses once.
std::size_t crossings(const BoundaryCurve& curve, const Vec2& from, const Vec2& to) {
  const Vec2 way = to - from;
  const auto offset = [&](const Vec2& point) {
    return way.x() * (point.y() - from.y()) - way.y() * (point.x() - from.x());
  };
  std::size_t count = 0;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const Vec2& a = curve.points[i];
    const Vec2& b = curve.points[(i + 1) % curve.points.size()];
    const double a_offset = offset(a);
    const double b_offset = offset(b);
    if ((a_offset >= 0.0) == (b_offset >= 0.0)) continue;
    const double along =
        core::fraction_along(from, to, a + a_offset / (a_offset - b_offset) * (b - a));
    if (along >= 0.0 && along <= 1.0) ++count;
  }
  return count;
}

}  // namespace

BugBounds bug_bounds(const ClearanceGrid& grid, double radius_m) {
  const Vec2 start = grid.world().start().position();
  const Vec2 target = grid.world().target();
  BugBounds bounds;
  bounds.straight_m = core::length(target - start);
  bounds.bug1_m = bounds.straight_m;
  bounds.bug2_m = bounds.straight_m;
  for (const BoundaryCurve& curve : boundary_curves(grid, radius_m)) {
    if (distance_m(curve, target) <= bounds.straight_m) {
      ++bounds.near_target;
      bounds.bug1_m += 1.5 * curve.length_m;
    }
    const std::size_t met = crossings(curve, start, target);
    bounds.crossings += met;
    bounds.bug2_m += 0.5 * static_cast<double>(met) * curve.length_m;
  }
  return bounds;
}

}  // namespace clew::world_analysis
