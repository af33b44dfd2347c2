// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

#include "run/pace.hpp"

namespace clew::bridge {

/// When a tick may begin, by the wall clock. Only the stage that starts ticks, drive, asks.
class TickClock {
 public:
  using Time = std::chrono::steady_clock::time_point;

  TickClock() = default;
  /// `factor`: simulated time over wall-clock time.
  TickClock(Pace pace, double factor, double tick_s)
      : pace_(pace),
        period_(std::chrono::duration_cast<std::chrono::steady_clock::duration>(
            std::chrono::duration<double>(pace == Pace::kLockstep ? 0.0 : tick_s / factor))) {}

  /// From simulated over wall-clock time; 0: no limit.
  static TickClock at_pace(double factor, double tick_s) {
    return {factor == 0.0 ? Pace::kLockstep : Pace::kScaled, factor, tick_s};
  }

  /// Tick `first` begins at `now`.
  void start(Time now, std::uint64_t first = 0) {
    start_ = now;
    first_ = first;
  }
  Time due(std::uint64_t tick) const {
    return start_ + static_cast<std::int64_t>(tick - first_) * period_;
  }
  /// In real time a tick begins when it is due, with the command of the tick before or without.
  bool is_realtime() const { return pace_ == Pace::kRealtime; }
  bool is_free() const { return pace_ == Pace::kLockstep; }

 private:
  Pace pace_ = Pace::kLockstep;
  std::chrono::steady_clock::duration period_{};
  Time start_{};
  std::uint64_t first_ = 0;
};

}  // namespace clew::bridge
