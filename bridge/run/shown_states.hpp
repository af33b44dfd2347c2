// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <iterator>
#include <optional>
#include <set>

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

/// The same for who knows of changes before they take effect, as those that are planned.
class ShownStates {
 public:
  /// Somebody looks on from `tick` on. Only the first call counts.
  void look_on(std::uint64_t tick) {
    if (looks_on_from_) return;
    looks_on_from_ = tick;
    from_.insert(tick);
  }
  /// Another behaviour takes over at `tick`, be it long after now.
  void change_at(std::uint64_t tick) { from_.insert(tick); }
  /// Whether the states of the checkpoint at `tick` are for who looks on: by the newest change
  /// before it, whatever comes later.
  bool shows(std::uint64_t tick) const {
    if (tick % kTicksPerCheckpoint != 0 || !looks_on_from_ || tick <= *looks_on_from_) return false;
    return shows_states(tick, *std::prev(from_.lower_bound(tick)));
  }

 private:
  std::optional<std::uint64_t> looks_on_from_;
  std::set<std::uint64_t> from_;
};

}  // namespace clew::bridge
