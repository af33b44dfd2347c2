// SPDX-License-Identifier: Apache-2.0
#include "recover/wall_follower.hpp"

#include <algorithm>

#include "core/angle.hpp"

namespace clew::recover {

std::array<double, 7> from_side(const domain::Scan& scan, Side side) {
  std::array<double, 7> u{};
  for (std::size_t i = 0; i < u.size(); ++i) {
    u[i] = scan.ranges_m[side == Side::kLeft ? i : u.size() - 1 - i] / scan.range_max_m;
  }
  return u;
}

bool at_break(const domain::Scan& scan, Side side, const WallRules& rules) {
  const auto u = from_side(scan, side);
  return std::min(u[0], u[1]) > rules.break_ratio;
}

domain::Motion follow_wall(const domain::Scan& scan, Side side, const WallRules& rules) {
  const auto u = from_side(scan, side);
  domain::Motion motion;
  motion.kind = domain::CommandKind::kTurnAndStep;
  const double front = std::min({u[2], u[3], u[4]});
  double toward_deg;
  if (front < rules.front_ratio) {
    toward_deg = -rules.blocked_turn_deg;
    motion.step_m = rules.slow_step_m;
  } else if (std::min(u[0], u[1]) > rules.break_ratio) {
    toward_deg = rules.break_turn_deg;
    motion.step_m = rules.break_step_m;
  } else {
    const double error = (u[0] - rules.side_ratio) / rules.side_ratio;
    toward_deg =
        std::clamp(rules.gain_deg * error, -rules.correct_turn_deg, rules.correct_turn_deg);
    motion.step_m = rules.step_m;
  }
  motion.turn_rad = sign(side) * core::radians(toward_deg);
  return motion;
}

}  // namespace clew::recover
