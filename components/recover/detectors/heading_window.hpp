// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "recover/situation.hpp"

namespace clew::recover {

/// The headings of the last ticks, and how much the robot has turned since each.
class HeadingWindow {
 public:
  struct Instant {
    std::uint64_t tick = 0;
    core::Vec2 position_odom = core::Vec2::Zero();
    double travel_m = 0.0;
    double turned_rad = 0.0;  ///< heading, summed up, so that turns beyond 180 degrees count
  };
  struct State {
    double heading_rad = 0.0;      ///< of the last tick
    std::deque<Instant> instants;  ///< oldest first, the last tick's included
  };
  /// A turn between an instant of the window and the last tick.
  struct Turn {
    Instant since;
    double turned_rad = 0.0;  ///< counter-clockwise
  };

  /// Looks `ticks` back.
  explicit HeadingWindow(std::size_t ticks) : ticks_(ticks) {}

  /// Takes a tick; the turn since the oldest instant from which it is more than `angle_rad`.
  std::optional<Turn> add(const Situation& situation, double angle_rad);

  void clear() { state_.instants.clear(); }
  State& state() { return state_; }
  const State& state() const { return state_; }

 private:
  std::size_t ticks_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, HeadingWindow::Instant& i) {
  visit(i.tick, i.position_odom, i.travel_m, i.turned_rad);
}
template <typename Visitor>
void visit_fields(Visitor& visit, HeadingWindow::State& s) {
  visit(s.heading_rad, s.instants);
}

}  // namespace clew::recover
