// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <vector>

namespace clew::bridge {

/// Wakes a thread that waits for descriptors from any other one.
class WakeUp {
 public:
  WakeUp();
  ~WakeUp();
  WakeUp(const WakeUp&) = delete;
  WakeUp& operator=(const WakeUp&) = delete;

  /// Wakes the wait that goes on, or the next one.
  void ring() const;
  /// Waits until it rings, one of the descriptors can be read, or the time is over. Negative
  /// descriptors are passed over.
  void wait_beside(const std::vector<int>& descriptors, std::chrono::nanoseconds most) const;

 private:
  int descriptor_;
};

}  // namespace clew::bridge
