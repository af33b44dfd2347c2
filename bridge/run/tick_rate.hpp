// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace clew::bridge {

/// How fast ticks go by, from the first one noted to the last.
class TickRate {
 public:
  using Time = std::chrono::steady_clock::time_point;

  void note(std::uint64_t tick, Time now) {
    if (!first_at_) {
      first_at_ = now;
      first_ = tick;
    }
    last_at_ = now;
    last_ = tick;
  }
  /// 0 before the second tick.
  double per_s() const {
    if (!first_at_ || last_at_ <= *first_at_) return 0.0;
    const double seconds = std::chrono::duration<double>(last_at_ - *first_at_).count();
    return static_cast<double>(last_ - first_) / seconds;
  }

 private:
  std::optional<Time> first_at_;
  Time last_at_{};
  std::uint64_t first_ = 0;
  std::uint64_t last_ = 0;
};

}  // namespace clew::bridge
