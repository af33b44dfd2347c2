// SPDX-License-Identifier: Apache-2.0
#include "ros2/robot_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angle.hpp"
#include "core/math.hpp"
#include "domain/topics.hpp"

namespace clew::ros2 {
namespace {

core::Error refuse(const std::string& why) { return {why}; }

/// Of x, y and yaw: the others of the six are no matter of a robot on a plane.
domain::PoseCovariance covariance_of(const PoseWithCovariance& pose) {
  const auto& c = pose.covariance;
  return {c[0], c[1], c[5], c[7], c[11], c[35]};
}

/// What is wrong with it, with the place in ROS's message; empty if nothing is.
std::string fault_of_covariance(const PoseWithCovariance& pose) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  const auto& c = pose.covariance;
  for (const std::size_t variance : {0, 7, 35}) {
    if (c[variance] >= 0.0 && c[variance] <= kLargest) continue;
    return fmt::format("pose.covariance[{}] is {}; a variance is finite and at least 0", variance,
                       c[variance]);
  }
  domain::Odometry probe;
  probe.covariance = covariance_of(pose);
  const auto valid = domain::validate(probe);
  if (valid.ok()) return {};
  return fmt::format(
      "pose.covariance[1], [5] and [11] are {}, {} and {}; between variances of {}, {} and {} each "
      "is at most the root of their product",
      c[1], c[5], c[11], c[0], c[7], c[35]);
}

/// Whether the laser measured something there: REP 117 and the limits of the message.
bool is_return(float range, const LaserScan& scan) {
  return std::isfinite(range) && range >= scan.range_min && range <= scan.range_max && range > 0.0F;
}

}  // namespace

double to_seconds(const Time& time) {
  return static_cast<double>(time.sec) + 1e-9 * static_cast<double>(time.nanosec);
}

double to_heading_rad(const Quaternion& q) {
  return core::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
}

core::Result<core::Pose2> to_pose2(const Pose& pose) {
  const Quaternion& q = pose.orientation;
  const double length = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  if (!std::isfinite(pose.position.x) || !std::isfinite(pose.position.y) ||
      !std::isfinite(length) || length < 0.5) {
    return refuse("a pose that is none");
  }
  return core::Pose2{pose.position.x, pose.position.y, core::wrap_angle_rad(to_heading_rad(q))};
}

core::Result<void> check_fan(const LaserScan& scan) {
  if (!std::isfinite(scan.angle_min) || !std::isfinite(scan.angle_increment)) {
    return refuse("a scan whose angles are not finite");
  }
  if (std::fabs(static_cast<double>(scan.angle_increment)) *
          static_cast<double>(scan.ranges.size()) >
      4.0 * core::kPi) {
    return refuse(
        fmt::format("a scan of {} beams of {} rad each", scan.ranges.size(), scan.angle_increment));
  }
  return {};
}

bool measured_anything(const LaserScan& scan) {
  return std::any_of(scan.ranges.begin(), scan.ranges.end(),
                     [&](float range) { return is_return(range, scan) || range > scan.range_max; });
}

std::vector<core::Vec2> returns_of(const LaserScan& scan, const core::Pose2& pose_robot_laser) {
  std::vector<core::Vec2> places;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (!is_return(scan.ranges[i], scan)) continue;
    const double bearing_rad = static_cast<double>(scan.angle_min) +
                               static_cast<double>(i) * static_cast<double>(scan.angle_increment) +
                               pose_robot_laser.heading_rad;
    places.push_back(pose_robot_laser.position() +
                     static_cast<double>(scan.ranges[i]) *
                         core::direction(core::wrap_angle_rad(bearing_rad)));
  }
  return places;
}

core::Result<domain::Scan> to_scan(const LaserScan& scan, const core::Pose2& pose_robot_laser,
                                   const domain::ScanLayout& layout, double radius_m) {
  CLEW_RETURN_IF_ERROR(check_fan(scan));
  domain::Scan out;
  out.bearing_first_rad = layout.bearing_first_rad;
  out.bearing_step_rad = layout.bearing_step_rad;
  out.beam_width_rad = layout.beam_width_rad;
  out.range_max_m = layout.range_max_m;
  out.ranges_m.assign(layout.beam_count, layout.range_max_m);
  const double step_rad = std::fabs(static_cast<double>(scan.angle_increment));
  const double half_rad = std::max(layout.beam_width_rad, step_rad) / 2.0;
  for (const core::Vec2& place : returns_of(scan, pose_robot_laser)) {
    const double from_skin_m = std::max(place.norm() - radius_m, 0.0);
    const double from_centre_rad = core::atan2(place.y(), place.x());
    for (std::size_t beam = 0; beam < layout.beam_count; ++beam) {
      const double off_rad = core::wrap_angle_rad(from_centre_rad - out.bearing_rad(beam));
      if (std::fabs(off_rad) > half_rad + 1e-9) continue;
      out.ranges_m[beam] = std::min(out.ranges_m[beam], from_skin_m);
    }
  }
  return out;
}

core::Result<domain::Odometry> OdometryInput::next(const Odometry& odometry) {
  const auto pose = to_pose2(odometry.pose.pose);
  if (!pose.ok()) return pose.error();
  if (has_previous_) travel_m_ += (pose->position() - previous_.position()).norm();
  previous_ = *pose;
  has_previous_ = true;
  domain::Odometry out;
  out.pose_odom_robot = *pose;
  const double speed_mps = odometry.twist.twist.linear.x;
  const double turn_rate_radps = odometry.twist.twist.angular.z;
  out.speed_mps = std::isfinite(speed_mps) ? speed_mps : 0.0;
  out.turn_rate_radps = std::isfinite(turn_rate_radps) ? turn_rate_radps : 0.0;
  out.travel_m = travel_m_;
  // Many robots fill in what is none.
  covariance_fault_ = fault_of_covariance(odometry.pose);
  if (covariance_fault_.empty()) out.covariance = covariance_of(odometry.pose);
  return out;
}

}  // namespace clew::ros2
