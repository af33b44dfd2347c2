// SPDX-License-Identifier: Apache-2.0
#include "plain_scan_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace clew::map {
namespace {

// Rays farther apart than this tell nothing of what is between them.
constexpr double kMostBetweenRays_rad = core::radians(2.5);
// Rays are taken together over these angles. A cell near the robot is wider than a narrow group:
// without the wide ones nothing there would ever be seen free, and what an outlier has left there
// would stay.
struct RayGroup {
  double width_rad;
  double reach_m;  // from the robot's centre; beyond it the narrower ones see as much
};
constexpr RayGroup kRayGroups[] = {
    {core::radians(6.0), HUGE_VAL}, {core::radians(24.0), 0.9}, {core::radians(96.0), 0.35}};
// Where a contact is beyond the skin: the drive's bumpers feel within a centimetre.
constexpr double kContactReach_m = 0.005;

}  // namespace

void PlainScanEvidence::mark(const domain::Odometry& odometry, const domain::Scan& scan,
                             SeenMap& seen) const {
  const core::Pose2& pose = odometry.pose_odom_robot;
  seen.mark_free(Sector(pose.position(), radius_m_));
  mark_free_parts(pose, scan, seen);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (scan.ranges_m[i] >= scan.range_max_m) continue;
    mark_arc(pose, radius_m_ + scan.ranges_m[i], pose.heading_rad + scan.bearing_rad(i),
             scan.beam_width_rad, seen);
  }
  for (const double bearing_rad : odometry.contact_bearings_rad) {
    seen.mark_hit(pose.position() +
                  (radius_m_ + kContactReach_m) * core::direction(pose.heading_rad + bearing_rad));
  }
}

void PlainScanEvidence::mark_free_parts(const core::Pose2& pose, const domain::Scan& scan,
                                        SeenMap& seen) const {
  const std::size_t count = scan.ranges_m.size();
  if (scan.beam_width_rad > 0.0) {
    for (std::size_t i = 0; i < count; ++i) mark_between(pose, scan, i, i, HUGE_VAL, {}, seen);
    const bool side_by_side =
        std::fabs(scan.bearing_step_rad) <= scan.beam_width_rad * (1.0 + 1e-9);
    for (std::size_t i = 1; side_by_side && i < count; ++i) {
      mark_between(pose, scan, i - 1, i, HUGE_VAL, {}, seen);
    }
    return;
  }
  const double step_rad = std::fabs(scan.bearing_step_rad);
  if (count < 2 || step_rad > kMostBetweenRays_rad) return;
  const SeenMap::IsGone is_gone = [&](const Vec2& place) {
    double nearest_rad = core::kPi;
    for (std::size_t i = 0; i < count; ++i) {
      const double off_rad =
          core::wrap_angle_rad(core::bearing_rad(pose, place) - scan.bearing_rad(i));
      nearest_rad = std::min(nearest_rad, std::fabs(off_rad));
    }
    return core::length(place - pose.position()) * nearest_rad <= 0.5 * seen.cell_m();
  };
  for (const RayGroup& wide : kRayGroups) {
    const auto group = static_cast<std::size_t>(std::max(2.0, wide.width_rad / step_rad));
    for (std::size_t i = 0; i + 1 < count; i += group / 2) {
      mark_between(pose, scan, i, std::min(count - 1, i + group), wide.reach_m, is_gone, seen);
    }
  }
}

/// Marks what the beams from `first` to `last` see free together: from the middle of the one to
/// that of the other, or all of a single one.
void PlainScanEvidence::mark_between(const core::Pose2& pose, const domain::Scan& scan,
                                     std::size_t first, std::size_t last, double reach_m,
                                     const SeenMap::IsGone& is_gone, SeenMap& seen) const {
  const auto begin = scan.ranges_m.begin();
  const double shortest_m = *std::min_element(begin + static_cast<std::ptrdiff_t>(first),
                                              begin + static_cast<std::ptrdiff_t>(last) + 1);
  if (shortest_m <= scan.range_min_m) return;
  const bool ends = shortest_m < scan.range_max_m;
  const double radius_m =
      std::min(reach_m, radius_m_ + shortest_m - (ends ? parameters_.clear_margin_m : 0.0));
  const double widening_rad = first == last ? 0.5 * scan.beam_width_rad : 0.0;
  const double right_rad = std::min(scan.bearing_rad(first), scan.bearing_rad(last)) - widening_rad;
  const double opening_rad =
      std::fabs(scan.bearing_rad(last) - scan.bearing_rad(first)) + 2.0 * widening_rad;
  seen.mark_free(Sector(pose.position(), radius_m, pose.heading_rad + right_rad, opening_rad),
                 is_gone);
}

void PlainScanEvidence::mark_arc(const core::Pose2& pose, double distance_m, double bearing_rad,
                                 double width_rad, SeenMap& seen) const {
  const double most_apart_m = 0.5 * seen.cell_m();
  const auto pieces = static_cast<std::size_t>(std::ceil(width_rad * distance_m / most_apart_m));
  if (pieces == 0) {  // a ray
    seen.mark_hit(pose.position() + distance_m * core::direction(bearing_rad - 0.5 * width_rad));
    return;
  }
  const auto place = [&](std::size_t i) -> Vec2 {
    const double share = static_cast<double>(i) / static_cast<double>(pieces);
    return pose.position() + distance_m * core::direction(bearing_rad + (share - 0.5) * width_rad);
  };
  std::size_t first = pieces + 1;
  std::size_t last = 0;
  for (std::size_t i = 0; i <= pieces; ++i) {
    if (seen.is(Mark::kFree, place(i))) continue;
    first = std::min(first, i);
    last = i;
  }
  const bool nothing_left = first > last;
  if (nothing_left) {
    first = 0;
    last = pieces;
  }
  const double spread_m =
      static_cast<double>(last - first) / static_cast<double>(pieces) * width_rad * distance_m;
  if (spread_m <= parameters_.hit_spread_m) {
    seen.mark_hit(place((first + last) / 2));
    return;
  }
  for (std::size_t i = first; i <= last; ++i) {
    if (nothing_left || !seen.is(Mark::kFree, place(i))) seen.mark_suspected(place(i));
  }
}

}  // namespace clew::map
