// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

#include "recover/situation.hpp"

namespace clew::recover {

/// When a robot that follows a boundary may leave it. The first two are Krishna & Kalra's and ours.
enum class LeavingRule : std::uint8_t { kNearer, kPaper, kBug2, kDistBug, kTangentBug };

/// What the rules of the Bug family remember of a boundary. T is the target, x the robot, H where
/// following began, S where the robot was when it got this target.
///
/// - *bug2* (Lumelsky & Stepanov 1987): x is on the line from S to T, nearer to T than H, and can
///   go toward T.
/// - *distbug* (Kamon & Rivlin 1997): d(x, T) - F <= d_min - STEP or F >= d(x, T), where F is free
///   space toward T and d_min the least distance to T since H.
/// - *tangentbug* (Kamon, Rimon & Rivlin 1998): d_reach < d_followed, where d_reach is the least
///   distance from T to a place in view that the robot may reach, and d_followed that to any part
///   of the boundary that was sensed.
///
/// *Deviations:* the robot is on a line in the tick in which it crosses it, and F is seen by beams
/// broad enough for the body. In *tangentbug*, places are those along the beams; the boundary is
/// all returns, as far as their readings, which is where the robot's skin would meet them; and it
/// counts since the robot last left one, since a trap is noticed only after its wall has been seen.
class LeavingRules {
 public:
  struct State {
    bool begun = false;
    core::Vec2 target_odom = core::Vec2::Zero();
    core::Vec2 start_odom = core::Vec2::Zero();  ///< S
    core::Vec2 hit_odom = core::Vec2::Zero();    ///< H
    double start_side = 0.0;                     ///< of the line S T that x is on: left > 0
    bool crossed_start_line = false;             ///< in this tick
    double least_m = 0.0;                        ///< d_min
    double followed_m = std::numeric_limits<double>::infinity();  ///< d_followed
  };

  /// Takes every tick, whether the robot follows or not.
  void watch(const Situation& situation);
  /// Following begins here.
  void hit(const Situation& situation);
  /// Following ends here.
  void leave() { state_.followed_m = std::numeric_limits<double>::infinity(); }

  /// Whether one of the Bug rules lets the robot leave. `free_m` is free space toward the target,
  /// 0 if that is not in view; `clear` whether that is enough to go there; `step_m` is STEP.
  bool may_leave(LeavingRule rule, const Situation& situation, double free_m, bool clear,
                 double step_m) const;

  State& state() { return state_; }
  const State& state() const { return state_; }

 private:
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, LeavingRules::State& s) {
  visit(s.begun, s.target_odom, s.start_odom, s.hit_odom, s.start_side, s.crossed_start_line,
        s.least_m, s.followed_m);
}

}  // namespace clew::recover
