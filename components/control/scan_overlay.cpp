// SPDX-License-Identifier: Apache-2.0
#include "control/scan_overlay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clew::control {
namespace {

using domain::VirtualObstacle;

constexpr double kNone = std::numeric_limits<double>::infinity();

/// Distance along a ray at which it enters the box, from outside; kNone if it misses.
double ray_distance_m(const VirtualObstacle& box, const core::Vec2& apex, double angle_rad) {
  const core::Vec2 along = core::direction(angle_rad);
  const double low[] = {box.x_min_m, box.y_min_m};
  const double high[] = {box.x_max_m, box.y_max_m};
  double enter_m = 0.0;
  double leave_m = kNone;
  for (int axis = 0; axis < 2; ++axis) {
    if (along[axis] == 0.0) {
      if (apex[axis] < low[axis] || apex[axis] > high[axis]) return kNone;
      continue;
    }
    const double a_m = (low[axis] - apex[axis]) / along[axis];
    const double b_m = (high[axis] - apex[axis]) / along[axis];
    enter_m = std::max(enter_m, std::min(a_m, b_m));
    leave_m = std::min(leave_m, std::max(a_m, b_m));
  }
  return enter_m <= leave_m ? enter_m : kNone;
}

/// Least distance to the box inside a cone. Box and cone are convex: it is the distance to the
/// box's nearest point if the cone holds that, else it lies on one of the cone's edges.
double cone_distance_m(const VirtualObstacle& box, const core::Vec2& apex, double angle_rad,
                       double half_width_rad) {
  const core::Vec2 nearest(std::clamp(apex.x(), box.x_min_m, box.x_max_m),
                           std::clamp(apex.y(), box.y_min_m, box.y_max_m));
  const core::Vec2 way = nearest - apex;
  const double off_axis_rad = core::wrap_angle_rad(core::atan2(way.y(), way.x()) - angle_rad);
  if (std::fabs(off_axis_rad) <= half_width_rad) return core::length(way);
  return std::min(ray_distance_m(box, apex, angle_rad - half_width_rad),
                  ray_distance_m(box, apex, angle_rad + half_width_rad));
}

bool holds(const VirtualObstacle& box, const core::Vec2& point) {
  return point.x() >= box.x_min_m && point.x() <= box.x_max_m && point.y() >= box.y_min_m &&
         point.y() <= box.y_max_m;
}

}  // namespace

void overlay_virtual_obstacles(const domain::Guidance& guidance, const core::Pose2& pose_odom_robot,
                               double radius_m, domain::Scan& scan) {
  const core::Vec2 apex = pose_odom_robot.position();
  for (const VirtualObstacle& box : guidance.virtual_obstacles) {
    if (holds(box, apex)) continue;
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const double angle_rad = pose_odom_robot.heading_rad + scan.bearing_rad(i);
      const double distance_m = cone_distance_m(box, apex, angle_rad, 0.5 * scan.beam_width_rad);
      scan.ranges_m[i] = std::clamp(distance_m - radius_m, 0.0, scan.ranges_m[i]);
    }
  }
}

}  // namespace clew::control
