// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/archive.hpp"
#include "domain/inside.hpp"
#include "recover/situation.hpp"

namespace clew::recover {

/// An earlier visit that proves that the robot is in a trap.
struct EarlierVisit {
  std::uint64_t tick = 0;
  core::Vec2 position_odom = core::Vec2::Zero();
  double travel_m = 0.0;   ///< path from there to where the robot is now
  std::uint32_t cell = 0;  ///< neuron, category or grid cell; 0 for rules that have none
};

template <typename Visitor>
void visit_fields(Visitor& visit, EarlierVisit& v) {
  visit(v.tick, v.position_odom, v.travel_m, v.cell);
}

/// Why a detector says *trap*.
struct TrapEvidence {
  std::optional<EarlierVisit> earlier;  ///< nothing for rules that see a trap at a glance
  std::string text;                     ///< for people, at most domain::kMaxTextLength bytes
  /// The robot goes on standing still, whoever leads it. Not saved: only Escape::take_up() asks, in
  /// the tick of the evidence.
  bool stands_still = false;
};

template <typename Visitor>
void visit_fields(Visitor& visit, TrapEvidence& e) {
  visit(e.earlier, e.text);
}

/// Notices that the robot is in a trap. A detector only watches: what to do is the escape's matter,
/// and any detector goes with any escape.
class TrapDetector {
 public:
  virtual ~TrapDetector() = default;

  /// Whether it needs Situation::local_map.
  virtual bool reads_local_map() const { return false; }

  /// Watches one tick; evidence if this tick proves a trap. Called every tick, also while an escape
  /// is at work, when evidence is only of use to escapes that ask for it.
  virtual std::optional<TrapEvidence> observe(const Situation& situation) = 0;

  /// What was remembered so far proves nothing about what comes: an escape has ended, for good or
  /// ill, or has set other targets or obstacles.
  virtual void start_afresh() = 0;

  /// Tells what it goes by after the last step, which was given this situation, and how near it is
  /// to saying trap: the number `alarm_share`, 1 when it does.
  virtual void tell(const Situation&, domain::Inside&) const {}

  virtual void save(core::StateWriter& writer) const = 0;
  virtual void load(core::StateReader& reader) = 0;
};

}  // namespace clew::recover
