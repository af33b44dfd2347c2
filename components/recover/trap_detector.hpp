// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/archive.hpp"
#include "recover/situation.hpp"

namespace clew::recover {

/// Why a detector says *trap*: the earlier visit that proves it.
struct TrapEvidence {
  std::uint64_t earlier_tick = 0;
  core::Vec2 earlier_position_odom = core::Vec2::Zero();
  double travel_m = 0.0;   ///< path between the two visits
  std::uint32_t cell = 0;  ///< neuron, category or grid cell
  std::string text;        ///< for people, at most domain::kMaxTextLength bytes
};

/// Notices that the robot is in a trap. A detector only watches: what to do is the escape's matter,
/// and any detector goes with any escape.
class TrapDetector {
 public:
  virtual ~TrapDetector() = default;

  /// Watches one tick; evidence if this tick proves a trap. Called every tick, also while an escape
  /// is at work, when evidence is ignored.
  virtual std::optional<TrapEvidence> observe(const Situation& situation) = 0;

  /// An escape has just ended, for good or ill: what was remembered before it proves nothing about
  /// what comes.
  virtual void escape_ended() = 0;

  virtual void save(core::StateWriter& writer) const = 0;
  virtual void load(core::StateReader& reader) = 0;
};

}  // namespace clew::recover
