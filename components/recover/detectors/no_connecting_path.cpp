// SPDX-License-Identifier: Apache-2.0
#include "recover/detectors/no_connecting_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angle.hpp"
#include "core/segment.hpp"
#include "scan/scan_needs.hpp"

namespace clew::recover {
namespace {

constexpr double kTolerance_rad = core::radians(1.0);
// A target farther than this from the one before is another one.
constexpr double kSameTarget_m = 1e-6;
// Free but for this is free: beams do not point exactly at the end of a leg.
constexpr double kSlack_m = 0.05;

/// How far the robot may go toward a bearing from its heading; nothing where it does not see.
std::optional<double> free_toward_m(const scan::SafeRegions& regions, double bearing_rad) {
  double least_off_rad = kTolerance_rad;
  std::optional<double> free_m;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const double off_rad = std::fabs(core::wrap_angle_rad(regions.bearing_rad(i) - bearing_rad));
    if (off_rad > least_off_rad) continue;
    least_off_rad = off_rad;
    free_m = regions.free_m(i);
  }
  return free_m;
}

}  // namespace

core::Result<std::unique_ptr<NoConnectingPath>> NoConnectingPath::create(
    const Parameters& parameters, const domain::BehaviourSetup& setup) {
  scan::ScanNeeds needs;
  needs.least_beams = 2;
  needs.most_unseen_rad = core::radians(15.0);
  needs.least_field_rad = core::radians(90.0);
  CLEW_RETURN_IF_ERROR(scan::check_needs(needs, setup.scan, "no_connecting_path"));
  return std::make_unique<NoConnectingPath>(parameters, setup.robot.radius_m);
}

NoConnectingPath::NoConnectingPath(const Parameters& parameters, double radius_m)
    : parameters_(parameters),
      radius_m_(radius_m),
      leg_regions_(radius_m, parameters.leg_clearance_m),
      path_regions_(radius_m, parameters.clearance_m) {}

std::optional<TrapEvidence> NoConnectingPath::observe(const Situation& situation) {
  const core::Vec2& target_odom = situation.pursued_odom;
  const bool same_target =
      state_.has_target && core::length(target_odom - state_.target_odom) <= kSameTarget_m;
  if (state_.has_target) {
    state_.travelled_m += core::length(situation.pose().position() - state_.position_odom);
  }
  state_.has_target = true;
  state_.target_odom = target_odom;
  state_.position_odom = situation.pose().position();
  leg_regions_.update(situation.scan);

  const auto free_m = free_toward_m(leg_regions_, core::bearing_rad(situation.pose(), target_odom));
  const double distance_m = core::distance_m(situation.pose(), target_odom);
  if (free_m && *free_m >= std::min(situation.scan.range_max_m, distance_m) - kSlack_m) {
    state_.on_leg = false;
    state_.told = false;
    return std::nullopt;
  }
  if (state_.on_leg && same_target && !leg_is_over(situation)) return std::nullopt;
  begin_leg(situation);
  if (!same_target || a_path_connects(situation)) {
    state_.told = false;
    return std::nullopt;
  }
  if (state_.told) return std::nullopt;
  state_.told = true;
  return TrapEvidence{std::nullopt, "no path in view connects to the target"};
}

double NoConnectingPath::depth_m(const Situation& situation) const {
  return std::min(parameters_.depth_ratio * situation.scan.range_max_m,
                  core::distance_m(situation.pose(), situation.pursued_odom));
}

bool NoConnectingPath::leg_is_over(const Situation& situation) const {
  const double left_m = core::distance_m(situation.pose(), state_.leg_end_odom);
  if (left_m <= parameters_.close_m) return true;
  if (state_.travelled_m >= parameters_.leg_travel_ratio * state_.leg_m) return true;
  const auto free_m =
      free_toward_m(leg_regions_, core::bearing_rad(situation.pose(), state_.leg_end_odom));
  return free_m && *free_m < std::min(situation.scan.range_max_m, left_m) - kSlack_m;
}

/// A leg to the nearest virtual target, or none where no direction is free.
void NoConnectingPath::begin_leg(const Situation& situation) {
  const core::Pose2& pose = situation.pose();
  const double target_rad = core::bearing_rad(pose, situation.pursued_odom);
  double length_m = depth_m(situation);
  state_.on_leg = false;
  state_.travelled_m = 0.0;
  for (int k = 0; k < scan::kSafeDepths && !state_.on_leg; ++k, length_m *= 0.5) {
    leg_regions_.find(length_m, gaps_);
    double least_m = std::numeric_limits<double>::max();
    for (const scan::SafeRegion& gap : gaps_) {
      const core::Vec2 end =
          pose.position() +
          length_m * core::direction(pose.heading_rad + gap.nearest_rad(target_rad));
      const double path_m = length_m + core::length(situation.pursued_odom - end);
      if (path_m >= least_m) continue;
      least_m = path_m;
      state_.on_leg = true;
      state_.leg_end_odom = end;
      state_.leg_m = length_m;
    }
  }
}

bool NoConnectingPath::a_path_connects(const Situation& situation) {
  const core::Pose2& pose = situation.pose();
  const domain::Scan& scan = situation.scan;
  path_regions_.update(scan);
  returns_.clear();
  returns_.reserve(scan.ranges_m.size());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (scan.ranges_m[i] >= scan.range_max_m) continue;
    returns_.push_back(pose.position() +
                       (radius_m_ + scan.ranges_m[i]) *
                           core::direction(pose.heading_rad + scan.bearing_rad(i)));
  }
  double length_m = depth_m(situation);
  for (int k = 0; k < scan::kSafeDepths; ++k, length_m *= 0.5) {
    for (std::size_t i = 0; i < path_regions_.size(); ++i) {
      if (path_regions_.free_m(i) < length_m) continue;
      const core::Vec2 end =
          pose.position() +
          length_m * core::direction(pose.heading_rad + path_regions_.bearing_rad(i));
      if (connects(end, situation.pursued_odom)) return true;
    }
  }
  return false;
}

/// Whether no return in view is in the body's way on a straight line.
bool NoConnectingPath::connects(const core::Vec2& from, const core::Vec2& to) const {
  const double room_m = radius_m_ + parameters_.clearance_m;
  return std::none_of(returns_.begin(), returns_.end(), [&](const core::Vec2& at) {
    return core::distance_to_segment_m(from, to, at) < room_m;
  });
}

void NoConnectingPath::save(core::StateWriter& writer) const { writer(state_); }

void NoConnectingPath::load(core::StateReader& reader) { reader(state_); }

}  // namespace clew::recover
