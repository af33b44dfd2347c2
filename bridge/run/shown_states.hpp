// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "run/pace.hpp"

namespace clew::bridge {

/// Whoever looks on gets the states of this many checkpoints first. Components hear at different
/// ticks that somebody looks on, and one that replaces another has to start before it hears. With
/// this many, all have one in common.
inline constexpr std::uint64_t kFirstShownStates = 16;
/// How often whoever looks on gets states after those.
inline constexpr std::uint64_t kTicksPerShownState = 64 * kTicksPerCheckpoint;

/// Whether whoever has looked on from `from` on, or from when another behaviour was put in, gets
/// the states of the checkpoint at `tick`, so that what components weighed at a tick can be told
/// without the ticks of long ago.
inline bool shows_states(std::uint64_t tick, std::uint64_t from) {
  if (tick <= from || tick % kTicksPerCheckpoint != 0) return false;
  return tick - from <= kFirstShownStates * kTicksPerCheckpoint || tick % kTicksPerShownState == 0;
}

}  // namespace clew::bridge
