// SPDX-License-Identifier: Apache-2.0
#include "map/scan_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

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

/// From a bearing to the nearest of the rays, all of which have the same step between them.
double to_nearest_ray_rad(const domain::Scan& scan, double bearing_rad) {
  const double step_rad = scan.bearing_step_rad;
  double off_rad = core::wrap_angle_rad(bearing_rad - scan.bearing_rad(0));
  // More than half a turn from the first ray, on the way of the others.
  if (off_rad * step_rad < -0.5 * step_rad * step_rad) {
    off_rad += std::copysign(2.0 * core::kPi, step_rad);
  }
  const double steps = off_rad / step_rad;
  return std::fabs(steps - std::round(steps)) * std::fabs(step_rad);
}

/// Whether what was hit at a place is gone if the beams show it free: rays must have gone through
/// its cell.
SeenMap::IsGone is_gone_by(const domain::Scan& scan, const core::Pose2& pose, double cell_m) {
  if (scan.beam_width_rad > 0.0) return {};
  return [&scan, &pose, cell_m](const Vec2& place) {
    return core::length(place - pose.position()) *
               to_nearest_ray_rad(scan, core::bearing_rad(pose, place)) <=
           0.5 * cell_m;
  };
}

}  // namespace

double ScanEvidence::Arc::angle_rad(std::size_t i) const {
  const double share = pieces == 0 ? 0.0 : static_cast<double>(i) / static_cast<double>(pieces);
  return bearing_rad + (share - 0.5) * width_rad;
}

void ScanEvidence::mark(const domain::Odometry& odometry, const domain::Scan& scan, SeenMap& seen) {
  const core::Pose2& pose = odometry.pose_odom_robot;
  const auto& ranges_m = scan.ranges_m;
  seen.begin_round();
  seen.mark_free(Sector(pose.position(), radius_m_));
  lay_out(scan);
  heading_ = core::direction(pose.heading_rad);
  const double farthest_m =
      ranges_m.empty() ? 0.0 : *std::max_element(ranges_m.begin(), ranges_m.end());
  window_.lay(seen, pose.position(), radius_m_ + farthest_m);
  const SeenMap::IsGone is_gone = is_gone_by(scan, pose, seen.cell_m());
  for (const Group& beams : fan_.groups) mark_free(pose, scan, beams, is_gone, seen);
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    if (ranges_m[i] >= scan.range_max_m) continue;
    Arc arc{pose.position(), radius_m_ + ranges_m[i], pose.heading_rad + scan.bearing_rad(i),
            scan.beam_width_rad, 0};
    if (arc.width_rad == 0.0) {
      mark_ray(arc, fan_.beams[i], seen);
      continue;
    }
    const double most_apart_m = 0.5 * seen.cell_m();
    arc.pieces = static_cast<std::size_t>(std::ceil(arc.width_rad * arc.distance_m / most_apart_m));
    mark_arc(arc, seen);
  }
  for (const double bearing_rad : odometry.contact_bearings_rad) {
    seen.mark_hit(pose.position() +
                  (radius_m_ + kContactReach_m) * core::direction(pose.heading_rad + bearing_rad));
  }
}

void ScanEvidence::lay_out(const domain::Scan& scan) {
  const bool same = fan_.beams.size() == scan.ranges_m.size() &&
                    fan_.bearing_first_rad == scan.bearing_first_rad &&
                    fan_.bearing_step_rad == scan.bearing_step_rad &&
                    fan_.beam_width_rad == scan.beam_width_rad;
  if (same) return;
  fan_ = {scan.bearing_first_rad, scan.bearing_step_rad, scan.beam_width_rad, {}, {}};
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    fan_.beams.push_back(core::direction(scan.bearing_rad(i)));
  }
  group_beams(scan);
}

void ScanEvidence::group_beams(const domain::Scan& scan) {
  const std::size_t count = scan.ranges_m.size();
  if (scan.beam_width_rad > 0.0) {
    for (std::size_t i = 0; i < count; ++i) group(scan, i, i, HUGE_VAL);
    const bool side_by_side =
        std::fabs(scan.bearing_step_rad) <= scan.beam_width_rad * (1.0 + 1e-9);
    for (std::size_t i = 1; side_by_side && i < count; ++i) group(scan, i - 1, i, HUGE_VAL);
    return;
  }
  const double step_rad = std::fabs(scan.bearing_step_rad);
  if (count < 2 || step_rad > kMostBetweenRays_rad) return;
  for (const RayGroup& wide : kRayGroups) {
    const auto rays = static_cast<std::size_t>(std::max(2.0, wide.width_rad / step_rad));
    for (std::size_t i = 0; i + 1 < count; i += rays / 2) {
      group(scan, i, std::min(count - 1, i + rays), wide.reach_m);
    }
  }
}

void ScanEvidence::group(const domain::Scan& scan, std::size_t first, std::size_t last,
                         double reach_m) {
  const double widening_rad = first == last ? 0.5 * scan.beam_width_rad : 0.0;
  const double right_rad = std::min(scan.bearing_rad(first), scan.bearing_rad(last)) - widening_rad;
  const double opening_rad =
      std::fabs(scan.bearing_rad(last) - scan.bearing_rad(first)) + 2.0 * widening_rad;
  fan_.groups.push_back({first, last, reach_m, right_rad, opening_rad, core::direction(right_rad),
                         core::direction(right_rad + opening_rad)});
}

/// A direction that was given with the robot's heading along x.
Vec2 ScanEvidence::turned(const Vec2& direction) const {
  return {heading_.x() * direction.x() - heading_.y() * direction.y(),
          heading_.y() * direction.x() + heading_.x() * direction.y()};
}

void ScanEvidence::mark_free(const core::Pose2& pose, const domain::Scan& scan, const Group& beams,
                             const SeenMap::IsGone& is_gone, SeenMap& seen) {
  const auto begin = scan.ranges_m.begin();
  const double shortest_m = *std::min_element(begin + static_cast<std::ptrdiff_t>(beams.first),
                                              begin + static_cast<std::ptrdiff_t>(beams.last) + 1);
  if (shortest_m <= scan.range_min_m) return;
  const bool ends = shortest_m < scan.range_max_m;
  const double radius_m =
      std::min(beams.reach_m, radius_m_ + shortest_m - (ends ? parameters_.clear_margin_m : 0.0));
  if (window_.mark_free({turned(beams.right), turned(beams.left), radius_m}, is_gone)) return;
  seen.mark_free(
      Sector(pose.position(), radius_m, pose.heading_rad + beams.right_rad, beams.opening_rad),
      is_gone);
}

void ScanEvidence::mark_ray(const Arc& ray, const Vec2& beam, SeenMap& seen) {
  if (window_.decides()) {
    window_.mark_obstacle(Mark::kHit, cell_of(ray, 0, turned(beam)));
  } else {
    seen.mark_hit(ray.place(0));
  }
}

void ScanEvidence::mark_arc(const Arc& arc, SeenMap& seen) {
  find_cells(arc);
  const bool decides = window_.decides();
  const auto is_free = [&](std::size_t i) {
    return decides ? window_.is(Mark::kFree, cells_[i]) : seen.is(Mark::kFree, arc.place(i));
  };
  const std::size_t pieces = arc.pieces;
  std::size_t first = pieces + 1;
  std::size_t last = 0;
  for (std::size_t i = 0; i <= pieces; ++i) {
    if (is_free(i)) continue;
    first = std::min(first, i);
    last = i;
  }
  const bool nothing_left = first > last;
  if (nothing_left) {
    first = 0;
    last = pieces;
  }
  const double spread_m = static_cast<double>(last - first) / static_cast<double>(pieces) *
                          arc.width_rad * arc.distance_m;
  if (spread_m <= parameters_.hit_spread_m) {
    seen.mark_hit(arc.place((first + last) / 2));
    return;
  }
  for (std::size_t i = first; i <= last; ++i) {
    if (!nothing_left && is_free(i)) continue;
    if (decides) {
      window_.mark_obstacle(Mark::kSuspected, cells_[i]);
    } else {
      seen.mark_suspected(arc.place(i));
    }
  }
}

/// The cells of all places of an arc. Each direction is the one before, turned by the same angle.
void ScanEvidence::find_cells(const Arc& arc) {
  cells_.clear();
  if (!window_.decides()) return;
  Vec2 at = core::direction(arc.angle_rad(0));
  const Vec2 step = core::direction(arc.width_rad / static_cast<double>(arc.pieces));
  for (std::size_t i = 0; i <= arc.pieces; ++i) {
    cells_.push_back(cell_of(arc, i, at));
    at = {at.x() * step.x() - at.y() * step.y(), at.y() * step.x() + at.x() * step.y()};
  }
}

/// The cell of a place of an arc that lies in about that direction.
SeenWindow::Cell ScanEvidence::cell_of(const Arc& arc, std::size_t i, const Vec2& direction) const {
  return window_.cell_at(
      arc.distance_m * direction, [&] { return arc.x_m(i); }, [&] { return arc.y_m(i); });
}

}  // namespace clew::map
