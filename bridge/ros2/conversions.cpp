// SPDX-License-Identifier: Apache-2.0
#include "ros2/conversions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/angle.hpp"
#include "core/math.hpp"

namespace clew::ros2 {

namespace {

/// Which of a pose's x, y, z and turns about them are those of the plane.
constexpr std::array<std::size_t, 3> kPlanar = {0, 1, 5};

}  // namespace

Frames Frames::of(const Names& names) {
  Frames frames;
  frames.odom = names.frame("odom");
  frames.base = names.frame("base_link");
  frames.laser = names.frame("laser");
  return frames;
}

Time to_time(double seconds) {
  const auto ns = static_cast<std::int64_t>(std::llround(seconds * 1e9));
  return {static_cast<std::int32_t>(ns / 1000000000), static_cast<std::uint32_t>(ns % 1000000000)};
}

Quaternion to_quaternion(double heading_rad) {
  return {0.0, 0.0, core::sin(heading_rad / 2.0), core::cos(heading_rad / 2.0)};
}

Pose to_pose(const core::Pose2& pose) {
  return {{pose.x_m, pose.y_m, 0.0}, to_quaternion(pose.heading_rad)};
}

LaserScan to_laser_scan(const domain::Scan& scan, const Frames& frames, double radius_m,
                        double tick_s) {
  LaserScan out;
  out.header = {to_time(scan.stamp.sim_time_s), frames.laser};
  const std::size_t count = scan.ranges_m.size();
  const bool clockwise = scan.bearing_step_rad < 0.0;
  const double last_rad = count > 0 ? scan.bearing_rad(count - 1) : scan.bearing_first_rad;
  out.angle_min = static_cast<float>(clockwise ? last_rad : scan.bearing_first_rad);
  out.angle_max = static_cast<float>(clockwise ? scan.bearing_first_rad : last_rad);
  out.angle_increment = static_cast<float>(std::fabs(scan.bearing_step_rad));
  out.scan_time = static_cast<float>(tick_s);
  out.range_min = static_cast<float>(scan.range_min_m + radius_m);
  out.range_max = static_cast<float>(scan.range_max_m + radius_m);
  out.ranges.reserve(count);
  for (const double range_m : scan.ranges_m) {
    out.ranges.push_back(range_m < scan.range_max_m ? static_cast<float>(range_m + radius_m)
                                                    : std::numeric_limits<float>::infinity());
  }
  if (clockwise) std::reverse(out.ranges.begin(), out.ranges.end());
  return out;
}

Odometry to_odometry(const domain::Odometry& odometry, const Frames& frames) {
  Odometry out;
  out.header = {to_time(odometry.stamp.sim_time_s), frames.odom};
  out.child_frame_id = frames.base;
  out.pose.pose = to_pose(odometry.pose_odom_robot);
  const domain::PoseCovariance& c = odometry.covariance;
  const std::array<std::array<double, 3>, 3> rows = {
      {{c.x_m2, c.xy_m2, c.x_heading_m_rad},
       {c.xy_m2, c.y_m2, c.y_heading_m_rad},
       {c.x_heading_m_rad, c.y_heading_m_rad, c.heading_rad2}}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      out.pose.covariance[6 * kPlanar[i] + kPlanar[j]] = rows[i][j];
    }
  }
  out.twist.twist.linear.x = odometry.speed_mps;
  out.twist.twist.angular.z = odometry.turn_rate_radps;
  return out;
}

PoseStamped to_goal(const domain::Target& target, const Frames& frames) {
  return {{to_time(target.stamp.sim_time_s), frames.odom},
          to_pose({target.x_m, target.y_m, target.heading_rad})};
}

Path to_path(const domain::Odometry& odometry, const domain::Guidance& guidance,
             const domain::Target& target, const Frames& frames) {
  Path path;
  path.header = {to_time(odometry.stamp.sim_time_s), frames.odom};
  const auto add = [&](const core::Pose2& pose) {
    path.poses.push_back({path.header, to_pose(pose)});
  };
  add(odometry.pose_odom_robot);
  if (guidance.target_is_virtual) add({guidance.target_x_m, guidance.target_y_m, 0.0});
  add({target.x_m, target.y_m, target.heading_rad});
  return path;
}

TransformStamped to_transform(const Time& stamp, const std::string& parent,
                              const std::string& child, const core::Pose2& pose) {
  TransformStamped out;
  out.header = {stamp, parent};
  out.child_frame_id = child;
  out.transform = {{pose.x_m, pose.y_m, 0.0}, to_quaternion(pose.heading_rad)};
  return out;
}

core::Pose2 odom_in_map(const core::Pose2& robot_in_map, const core::Pose2& robot_in_odom) {
  const double turn_rad =
      core::wrap_angle_rad(robot_in_map.heading_rad - robot_in_odom.heading_rad);
  const double c = core::cos(turn_rad);
  const double s = core::sin(turn_rad);
  return {robot_in_map.x_m - (c * robot_in_odom.x_m - s * robot_in_odom.y_m),
          robot_in_map.y_m - (s * robot_in_odom.x_m + c * robot_in_odom.y_m), turn_rad};
}

OccupancyGrid to_grid(const world::World& world, const Frames& frames, double cell_m,
                      std::size_t most_cells) {
  const core::Vec2 size = world.bounds_max() - world.bounds_min();
  const auto cells_along = [&](double length_m) {
    return static_cast<std::uint32_t>(std::ceil(length_m / cell_m - 1e-9));
  };
  while (static_cast<double>(cells_along(size.x())) * cells_along(size.y()) >
         static_cast<double>(most_cells)) {
    cell_m *= 2.0;
  }
  OccupancyGrid grid;
  grid.header.frame_id = frames.map;
  grid.info.resolution = static_cast<float>(cell_m);
  grid.info.width = cells_along(size.x());
  grid.info.height = cells_along(size.y());
  grid.info.origin = to_pose({world.bounds_min().x(), world.bounds_min().y(), 0.0});
  grid.data.reserve(static_cast<std::size_t>(grid.info.width) * grid.info.height);
  const double half_diagonal_m = cell_m * std::sqrt(0.5);
  for (std::uint32_t row = 0; row < grid.info.height; ++row) {
    for (std::uint32_t column = 0; column < grid.info.width; ++column) {
      const core::Vec2 middle = world.bounds_min() + cell_m * core::Vec2(column + 0.5, row + 0.5);
      const bool is_free = world.standing_clearance_m(middle, half_diagonal_m) >= half_diagonal_m;
      grid.data.push_back(is_free ? 0 : 100);
    }
  }
  return grid;
}

}  // namespace clew::ros2
