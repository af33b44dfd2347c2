// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/angle.hpp"
#include "domain/setup.hpp"

namespace clew::domain {

/// For how many ticks a robot that wants to get on has to stay within within_m to count as held:
/// the longest of held_s, half as long again as half a turn and that way take one that nothing
/// holds, and 12 ticks. A robot that is slow, or has long ticks, is not held: it is not there yet.
inline std::uint64_t held_ticks(double held_s, double within_m, const BehaviourSetup& setup) {
  constexpr double kShare = 1.5;
  constexpr double kLeastTicks = 12.0;
  constexpr double kMostTicks = 1e15;
  const MotionLimits& limits = setup.limits;
  const double free_s = core::kPi / limits.turn_rate_radps + within_m / limits.speed_mps;
  const double ticks = std::ceil(std::max(held_s, kShare * free_s) / setup.tick_s);
  return static_cast<std::uint64_t>(std::clamp(ticks, kLeastTicks, kMostTicks));
}

}  // namespace clew::domain
