// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/following/leaving_rules.hpp"

#include <algorithm>
#include <cmath>

#include "core/segment.hpp"

namespace clew::recover {
namespace {

/// Which side of the line from a to b a point is on: left > 0.
double side_of_line(const core::Vec2& a, const core::Vec2& b, const core::Vec2& point) {
  const core::Vec2 way = b - a;
  const core::Vec2 offset = point - a;
  return way.x() * offset.y() - way.y() * offset.x();
}

bool crosses(double side_before, double side_now) {
  return (side_before > 0.0 && side_now <= 0.0) || (side_before < 0.0 && side_now >= 0.0);
}

/// d_reach of TangentBug.
double reachable_m(const Situation& situation) {
  double least_m = situation.target_distance_m();
  const core::Vec2 here = situation.pose().position();
  for (std::size_t i = 0; i < situation.scan.ranges_m.size(); ++i) {
    const core::Vec2 along =
        core::direction(situation.pose().heading_rad + situation.scan.bearing_rad(i));
    const core::Vec2 end = here + situation.scan.ranges_m[i] * along;
    least_m = std::min(least_m, core::distance_to_segment_m(here, end, situation.target_odom));
  }
  return least_m;
}

/// Distance from the target to the nearest part of a boundary in view.
double boundary_m(const Situation& situation) {
  const domain::Scan& scan = situation.scan;
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (scan.ranges_m[i] >= scan.range_max_m) continue;
    const core::Vec2 along = core::direction(situation.pose().heading_rad + scan.bearing_rad(i));
    const core::Vec2 point = situation.pose().position() + scan.ranges_m[i] * along;
    least_m = std::min(least_m, core::length(situation.target_odom - point));
  }
  return least_m;
}

}  // namespace

void LeavingRules::watch(const Situation& situation) {
  const core::Vec2 position = situation.pose().position();
  if (!state_.begun || situation.target_odom != state_.target_odom) {
    state_.begun = true;
    state_.target_odom = situation.target_odom;
    state_.start_odom = position;
    state_.start_side = 0.0;
    leave();
  }
  state_.least_m = std::min(state_.least_m, situation.target_distance_m());
  state_.followed_m = std::min(state_.followed_m, boundary_m(situation));
  const double start_side = side_of_line(state_.start_odom, state_.target_odom, position);
  state_.crossed_start_line = crosses(state_.start_side, start_side);
  state_.start_side = start_side;
}

void LeavingRules::hit(const Situation& situation) {
  state_.hit_odom = situation.pose().position();
  state_.least_m = situation.target_distance_m();
}

bool LeavingRules::may_leave(LeavingRule rule, const Situation& situation, double free_m,
                             bool clear, double step_m) const {
  const double distance_m = situation.target_distance_m();
  const double hit_distance_m = core::length(state_.target_odom - state_.hit_odom);
  switch (rule) {
    case LeavingRule::kBug2:
      return state_.crossed_start_line && distance_m < hit_distance_m && clear;
    case LeavingRule::kDistBug:
      return free_m >= distance_m || distance_m - free_m <= state_.least_m - step_m;
    case LeavingRule::kTangentBug:
      return reachable_m(situation) < state_.followed_m;
    case LeavingRule::kNearer:
    case LeavingRule::kPaper:
      break;
  }
  return false;
}

}  // namespace clew::recover
