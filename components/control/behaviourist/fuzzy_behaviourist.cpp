// SPDX-License-Identifier: Apache-2.0
#include "control/behaviourist/fuzzy_behaviourist.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"

namespace clew::control {
namespace {

constexpr double kFront_rad = core::radians(25.0);
constexpr double kSide_rad = core::radians(100.0);

enum class Sector { kFront, kLeft, kRight, kBack };

Sector sector_of(double bearing_rad) {
  const double wrapped_rad = core::wrap_angle_rad(bearing_rad);
  if (std::fabs(wrapped_rad) <= kFront_rad) return Sector::kFront;
  if (std::fabs(wrapped_rad) > kSide_rad) return Sector::kBack;
  return wrapped_rad > 0.0 ? Sector::kLeft : Sector::kRight;
}

bool sees_three_sectors(const domain::ScanLayout& scan) {
  bool front = false;
  bool left = false;
  bool right = false;
  for (std::size_t i = 0; i < scan.beam_count; ++i) {
    const Sector sector =
        sector_of(scan.bearing_first_rad + static_cast<double>(i) * scan.bearing_step_rad);
    front = front || sector == Sector::kFront;
    left = left || sector == Sector::kLeft;
    right = right || sector == Sector::kRight;
  }
  return front && left && right;
}

}  // namespace

core::Result<std::unique_ptr<FuzzyBehaviourist>> FuzzyBehaviourist::create(
    const Parameters& parameters, const domain::BehaviourSetup& setup) {
  if (!sees_three_sectors(setup.scan)) {
    return core::Error{fmt::format(
        "fuzzy_behaviourist needs beams ahead (within 25 degrees), on the left and on "
        "the right (25 to 100 degrees); '{}' gives {}, from {:.4g} degrees in steps of "
        "{:.4g}",
        setup.scan.sensor, setup.scan.beam_count, core::degrees(setup.scan.bearing_first_rad),
        core::degrees(setup.scan.bearing_step_rad))};
  }
  const auto resource = setup.resources.find("rulebases", parameters.rules);
  if (!resource.ok()) return resource.error();
  auto rules = BehaviouristRules::parse(*resource);
  if (!rules.ok()) return rules.error();
  return std::make_unique<FuzzyBehaviourist>(std::move(rules).value());
}

domain::Motion FuzzyBehaviourist::step(const domain::Odometry& odometry, const domain::Scan& scan,
                                       const core::Vec2& target_odom) {
  double front_m = scan.range_max_m;
  double left_m = scan.range_max_m;
  double right_m = scan.range_max_m;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    switch (sector_of(scan.bearing_rad(i))) {
      case Sector::kFront:
        front_m = std::min(front_m, scan.ranges_m[i]);
        break;
      case Sector::kLeft:
        left_m = std::min(left_m, scan.ranges_m[i]);
        break;
      case Sector::kRight:
        right_m = std::min(right_m, scan.ranges_m[i]);
        break;
      case Sector::kBack:
        break;
    }
  }
  const double target_rad = core::bearing_rad(odometry.pose_odom_robot, target_odom);
  stimuli_ = {target_rad, front_m, left_m, right_m, left_m - right_m};
  const BehaviouristRules::Response response = rules_.respond(stimuli_);
  domain::Motion motion;
  motion.kind = domain::CommandKind::kVelocities;
  motion.turn_rate_radps = response.turn_rate_radps;
  motion.speed_mps = response.speed_mps;
  return motion;
}

}  // namespace clew::control
