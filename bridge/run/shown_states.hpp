// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "run/pace.hpp"

namespace clew::bridge {

/// How often whoever looks on gets states, after the first.
inline constexpr std::uint64_t kTicksPerShownState = 64 * kTicksPerCheckpoint;

/// Whether whoever has looked on from `from` on, or from when another behaviour was put in, gets
/// the states of the checkpoint at `tick`: those of the first two, of which one is common to all
/// components, and then now and then, so that what components weighed at a tick can be told without
/// the ticks of long ago.
inline bool shows_states(std::uint64_t tick, std::uint64_t from) {
  if (tick <= from || tick % kTicksPerCheckpoint != 0) return false;
  return tick - from <= 2 * kTicksPerCheckpoint || tick % kTicksPerShownState == 0;
}

}  // namespace clew::bridge
