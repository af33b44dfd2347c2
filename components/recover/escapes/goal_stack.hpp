// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

#include "core/archive.hpp"
#include "core/bounded_vector.hpp"
#include "domain/inside.hpp"
#include "recover/situation.hpp"

namespace clew::recover {

/// Virtual targets above the mission's: the newest is pursued, and where the robot is done with it,
/// the one below. One that it does not come nearer to is dropped, since it may lie in an obstacle
/// or out of reach.
class GoalStack {
 public:
  static constexpr std::size_t kCapacity = 16;

  struct Goal {
    core::Vec2 position_odom = core::Vec2::Zero();
    double least_m = std::numeric_limits<double>::infinity();  ///< distance so far
    std::uint64_t progress_tick = 0;  ///< when that was last undercut, or its pursuit began
  };
  struct State {
    core::BoundedVector<Goal, kCapacity> goals;  ///< the newest last
  };
  enum class Change : std::uint8_t { kNone, kReached, kDropped };

  /// Reached within `close_m`; dropped after `patience_ticks` without coming nearer.
  GoalStack(double close_m, double patience_ticks)
      : close_m_(close_m), patience_ticks_(patience_ticks) {}

  /// Puts a goal on top, which `full()` must allow.
  void push(const core::Vec2& position_odom, std::uint64_t tick);
  /// Takes the top goal off; the one below begins anew.
  void pop(std::uint64_t tick);
  void clear() { state_.goals.clear(); }

  /// Takes a tick of pursuing the top goal, if any, and takes that off if it is reached or dropped.
  Change update(const Situation& situation);

  /// Tells the goals, the newest first.
  void tell(const Situation& situation, domain::Inside& inside) const;

  bool empty() const { return state_.goals.empty(); }
  bool full() const { return state_.goals.full(); }
  /// Of a stack that is not empty.
  const core::Vec2& top_odom() const { return state_.goals[state_.goals.size() - 1].position_odom; }

  State& state() { return state_; }
  const State& state() const { return state_; }

 private:
  double close_m_;
  double patience_ticks_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, GoalStack::Goal& g) {
  visit(g.position_odom, g.least_m, g.progress_tick);
}
template <typename Visitor>
void visit_fields(Visitor& visit, GoalStack::State& s) {
  visit(s.goals);
}

}  // namespace clew::recover
