// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <ctime>

namespace clew::bridge {

/// Tells whether a thread is at work, and that it gets on: how much processor time it has had. Work
/// that takes long uses some, however busy the machine is; work that is stuck uses none. One thread
/// works at a time, and any may ask meanwhile; nobody waits.
class BusyThread {
 public:
  /// The calling thread begins to work, or has ended.
  void begin();
  void end() { clock_ = kNobody; }

  bool is_busy() const { return clock_.load() != kNobody; }
  /// Processor time of the thread that is at work, since it was started; 0: none is.
  std::uint64_t processor_ns() const;

 private:
  static constexpr clockid_t kNobody = CLOCK_REALTIME;  ///< the clock of no thread

  std::atomic<clockid_t> clock_{kNobody};
};

}  // namespace clew::bridge
