// SPDX-License-Identifier: Apache-2.0
#include "control/gaps/nearest_virtual_target.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angle.hpp"
#include "scan/nearest_return.hpp"
#include "scan/scan_needs.hpp"

namespace clew::control {
namespace {

// A virtual target on the straight way to the target is none in the paper's sense.
constexpr double kStraight_rad = 1e-6;

/// Gaps can be told where no blind sector is over 15 degrees, and 45 degrees are seen on each side.
scan::ScanNeeds gap_needs() {
  scan::ScanNeeds needs;
  needs.least_beams = 2;
  needs.most_unseen_rad = core::radians(15.0);
  needs.least_axis_rad = core::radians(45.0);
  return needs;
}

}  // namespace

core::Result<std::unique_ptr<NearestVirtualTarget>> NearestVirtualTarget::create(
    const Parameters& parameters, const domain::BehaviourSetup& setup) {
  CLEW_RETURN_IF_ERROR(scan::check_needs(gap_needs(), setup.scan, "nearest_virtual_target"));
  const auto resource = setup.resources.find("rulebases", parameters.rules);
  if (!resource.ok()) return resource.error();
  const auto rules = VirtualTargetRules::parse(*resource);
  if (!rules.ok()) return rules.error();
  return std::make_unique<NearestVirtualTarget>(parameters, *rules, setup.robot.radius_m,
                                                setup.tick_s);
}

NearestVirtualTarget::NearestVirtualTarget(const Parameters& parameters,
                                           const VirtualTargetRules& rules, double radius_m,
                                           double tick_s)
    : parameters_(parameters),
      rules_(rules),
      tick_s_(tick_s),
      regions_(radius_m, parameters.clearance_m) {}

domain::Motion NearestVirtualTarget::step(const domain::Odometry& odometry,
                                          const domain::Scan& scan, const core::Vec2& target_odom) {
  const core::Pose2& pose = odometry.pose_odom_robot;
  regions_.update(scan);
  const auto virtual_target = choose(pose, target_odom, scan.range_max_m);
  const double bearing_rad = core::bearing_rad(pose, virtual_target.value_or(target_odom));
  steers_for_target_ =
      std::fabs(core::wrap_angle_rad(bearing_rad - core::bearing_rad(pose, target_odom))) <
      kStraight_rad;
  domain::Motion motion = steer(bearing_rad, scan);
  if (!virtual_target) motion.speed_mps = 0.0;
  return motion;
}

/// Where to go: the target itself or the nearest virtual target; none if no direction is free.
std::optional<core::Vec2> NearestVirtualTarget::choose(const core::Pose2& pose,
                                                       const core::Vec2& target_odom,
                                                       double range_m) {
  double depth_m = std::min(parameters_.depth_ratio * range_m, core::distance_m(pose, target_odom));
  for (int i = 0; i < scan::kSafeDepths; ++i, depth_m *= 0.5) {
    regions_.find(depth_m, gaps_);
    if (gaps_.empty()) continue;
    state_.virtual_target_odom = nearest_gap(pose, target_odom, depth_m);
    state_.has_gap = true;
    return state_.virtual_target_odom;
  }
  state_.has_gap = false;
  return std::nullopt;
}

/// The gap that it goes for: the one nearest to where its virtual target was; null if none is.
const scan::SafeRegion* NearestVirtualTarget::kept_gap(const core::Pose2& pose) const {
  if (!state_.has_gap) return nullptr;
  const double kept_rad = core::bearing_rad(pose, state_.virtual_target_odom);
  const auto off_rad = [&](const scan::SafeRegion& gap) {
    return std::fabs(core::wrap_angle_rad(gap.nearest_rad(kept_rad) - kept_rad));
  };
  return &*std::min_element(gaps_.begin(), gaps_.end(),
                            [&](const auto& a, const auto& b) { return off_rad(a) < off_rad(b); });
}

/// The virtual target with the shortest path, or that of the gap that it goes for, if as good.
core::Vec2 NearestVirtualTarget::nearest_gap(const core::Pose2& pose, const core::Vec2& target_odom,
                                             double depth_m) {
  const double target_rad = core::bearing_rad(pose, target_odom);
  const scan::SafeRegion* const kept = kept_gap(pose);
  core::Vec2 best = target_odom;
  double least_m = std::numeric_limits<double>::max();
  for (const scan::SafeRegion& gap : gaps_) {
    const double angle_rad = pose.heading_rad + gap.nearest_rad(target_rad);
    const core::Vec2 candidate = pose.position() + depth_m * core::direction(angle_rad);
    double path_m = depth_m + core::length(target_odom - candidate);
    if (&gap == kept) path_m -= parameters_.keep_m;
    if (path_m < least_m) {
      least_m = path_m;
      best = candidate;
    }
  }
  return best;
}

/// Table 1, toward a virtual target at this bearing.
domain::Motion NearestVirtualTarget::steer(double bearing_rad, const domain::Scan& scan) const {
  const scan::Return nearest = scan::nearest_return(scan);
  const double position_rad =
      nearest.range_m < scan.range_max_m
          ? std::fabs(core::wrap_angle_rad(nearest.bearing_rad - bearing_rad))
          : core::kPi;
  const VirtualTargetRules::Output output = rules_.infer(position_rad, nearest.range_m);
  domain::Motion motion;
  motion.kind = domain::CommandKind::kVelocities;
  const double most_radps = std::min(output.turn_rate_radps, std::fabs(bearing_rad) / tick_s_);
  motion.turn_rate_radps = bearing_rad < 0.0 ? -most_radps : most_radps;
  motion.speed_mps = output.speed_mps * std::max(0.0, core::cos(bearing_rad));
  return motion;
}

void NearestVirtualTarget::tell_virtual_targets(VirtualTargets& targets) const {
  if (!state_.has_gap || steers_for_target_) return;
  targets.push_back({state_.virtual_target_odom.x(), state_.virtual_target_odom.y()});
}

void NearestVirtualTarget::save(core::StateWriter& writer) const { writer(state_); }

void NearestVirtualTarget::load(core::StateReader& reader) { reader(state_); }

}  // namespace clew::control
