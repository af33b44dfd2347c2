// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/following/wall_follower.hpp"

#include <algorithm>

#include "core/fuzzy.hpp"
#include "scan/nearest_return.hpp"

namespace clew::recover {
namespace {

/// Readings as shares of the range, the wall's side first.
std::array<double, WallFollower::kBeams> from_side(const domain::Scan& scan, Side side) {
  std::array<double, WallFollower::kBeams> u{};
  for (std::size_t i = 0; i < u.size(); ++i) {
    const std::size_t beam = side == Side::kLeft ? i : u.size() - 1 - i;
    u[i] = scan.ranges_m[beam] / scan.range_max_m;
  }
  return u;
}

}  // namespace

WallRules WallRules::scaled(double share) const {
  WallRules rules = *this;
  for (double* length :
       {&rules.blocked_full_ratio, &rules.blocked_none_ratio, &rules.close_ratio, &rules.good_ratio,
        &rules.far_ratio, &rules.break_ratio, &rules.blocked_step_m, &rules.free_step_m}) {
    *length *= share;
  }
  return rules;
}

domain::Motion WallFollower::follow(const domain::Scan& scan, Side side) const {
  const auto u = from_side(scan, side);
  const double u_side = u[0];
  const double u_front = std::min({u[2], u[3], u[4]});

  const double blocked =
      core::falling_membership(u_front, rules_.blocked_full_ratio, rules_.blocked_none_ratio);
  const double close = core::falling_membership(u_side, rules_.close_ratio, rules_.good_ratio);
  const double far = 1.0 - core::falling_membership(u_side, rules_.good_ratio, rules_.far_ratio);
  const double free = 1.0 - blocked;
  const double toward_rad = blocked * rules_.blocked_turn_rad +
                            free * (close * rules_.close_turn_rad + far * rules_.far_turn_rad);

  domain::Motion motion;
  motion.kind = domain::CommandKind::kTurnAndStep;
  motion.turn_rad = sign(side) * toward_rad;
  motion.step_m = blocked * rules_.blocked_step_m + free * rules_.free_step_m;
  return motion;
}

bool WallFollower::at_break(const domain::Scan& scan, Side side) const {
  const auto u = from_side(scan, side);
  return std::min(u[0], u[1]) > rules_.break_ratio;
}

bool WallFollower::sees_obstacle(const domain::Scan& scan) const {
  return scan::nearest_return(scan).range_m / scan.range_max_m <= rules_.break_ratio;
}

}  // namespace clew::recover
