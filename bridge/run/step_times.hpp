// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace clew::bridge {

/// How long steps took, of `count` of them.
struct StepTimes {
  std::uint64_t count = 0;  ///< 0: nothing is known
  double p50_us = 0.0;
  double p99_us = 0.0;
};

template <typename V>
void visit_fields(V& v, StepTimes& times) {
  v(times.count, times.p50_us, times.p99_us);
}

/// The durations of the last 512 steps. One thread adds at a time, and another one may look
/// meanwhile; nobody waits.
class RecentSteps {
 public:
  void add(std::chrono::nanoseconds duration);
  /// Median and 99th percentile, by nearest rank.
  StepTimes times() const;

 private:
  static constexpr std::size_t kMost = 512;
  std::array<std::atomic<std::uint32_t>, kMost> ns_{};  ///< beyond four seconds: four seconds
  std::atomic<std::uint64_t> count_{0};
};

}  // namespace clew::bridge
