// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>

namespace clew::bridge {

/// While it lives, the signals that ask for an end are blocked and read from a descriptor, and so
/// is SIGCHLD, which only wakes a poll. Also those that came while they were blocked before. To be
/// made before any thread is started, since threads inherit what is blocked.
class EndSignals {
 public:
  EndSignals();
  ~EndSignals();
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;

  int descriptor() const { return descriptor_; }
  /// The last signal that asks for an end since the last call, or 0. Does not wait.
  int take();

 private:
  sigset_t set_{};
  sigset_t before_{};
  int descriptor_ = -1;
};

}  // namespace clew::bridge
