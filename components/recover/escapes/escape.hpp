// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/archive.hpp"
#include "recover/detectors/trap_detector.hpp"
#include "recover/situation.hpp"

namespace clew::recover {

enum class EscapeStatus : std::uint8_t {
  kActive,      ///< goes on
  kLooksAgain,  ///< goes on, and all that was seen must be forgotten and seen afresh
  kEnded,       ///< the way is open: back to seeking
  kFailed,      ///< cannot help: the next escape's turn
  kUnreachable  ///< has proved that there is no way to the target
};

/// A way out of a trap. It speaks through the guidance alone: another target, virtual obstacles, or
/// a motion that overrides the controller's.
class Escape {
 public:
  virtual ~Escape() = default;

  /// Whether it needs Situation::local_map.
  virtual bool reads_local_map() const { return false; }

  /// Watches every tick before anything else, whether this escape is at work or not.
  virtual void watch(const Situation&) {}

  /// A trap was noticed; step() follows in the same tick.
  virtual void begin(const Situation& situation, const TrapEvidence& evidence) = 0;

  /// A trap was noticed while this escape is at work; step() follows. True if it takes that up: the
  /// trap is logged then, and the detectors start afresh.
  virtual bool take_up(const Situation&, const TrapEvidence&) { return false; }

  /// One tick at work; why it failed or holds the target unreachable goes into `guidance.why`.
  /// `guidance` comes set to the mission's target and mode kRecover.
  virtual EscapeStatus step(const Situation& situation, domain::Guidance& guidance) = 0;

  /// Tells how far it has got, at work in the last step, which was given this situation.
  virtual void tell(const Situation&, domain::Inside&) const {}

  virtual void save(core::StateWriter& writer) const = 0;
  virtual void load(core::StateReader& reader) = 0;
};

}  // namespace clew::recover
