// SPDX-License-Identifier: Apache-2.0
#include "random_messages.hpp"

#include <cmath>
#include <utility>

namespace clew::bridge {

double RandomMessages::number(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(engine_);
}

std::uint32_t RandomMessages::count(std::size_t last) {
  return std::uniform_int_distribution<std::uint32_t>(0, static_cast<std::uint32_t>(last))(engine_);
}

std::string RandomMessages::text(std::size_t bound) {
  std::string text(count(bound), ' ');
  for (char& c : text) c = static_cast<char>('a' + count(25));
  return text;
}

void RandomMessages::agree(domain::Motion& motion) {
  const auto keep = [&](double& number, domain::CommandKind user) {
    if (motion.kind != user) number = 0.0;
  };
  keep(motion.turn_rad, domain::CommandKind::kTurnAndStep);
  keep(motion.step_m, domain::CommandKind::kTurnAndStep);
  keep(motion.speed_mps, domain::CommandKind::kVelocities);
  keep(motion.turn_rate_radps, domain::CommandKind::kVelocities);
  keep(motion.left_mps, domain::CommandKind::kWheelSpeeds);
  keep(motion.right_mps, domain::CommandKind::kWheelSpeeds);
}

void RandomMessages::agree(domain::VirtualObstacle& box) {
  box.x_min_m = box.x_max_m - number(0.0, 9.0);
  box.y_min_m = box.y_max_m - number(0.0, 9.0);
}

void RandomMessages::agree(domain::PoseCovariance& c) {
  c.xy_m2 = number(-1.0, 1.0) * std::sqrt(c.x_m2) * std::sqrt(c.y_m2);
  c.x_heading_m_rad = number(-1.0, 1.0) * std::sqrt(c.x_m2) * std::sqrt(c.heading_rad2);
  c.y_heading_m_rad = number(-1.0, 1.0) * std::sqrt(c.y_m2) * std::sqrt(c.heading_rad2);
}

void RandomMessages::agree(domain::Target& target) {
  if (target.waypoint > target.waypoints) std::swap(target.waypoint, target.waypoints);
}

void RandomMessages::agree(domain::Scan& scan) {
  for (double& range : scan.ranges_m) range *= scan.range_max_m;
}

}  // namespace clew::bridge
