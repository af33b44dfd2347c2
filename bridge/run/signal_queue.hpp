// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>

namespace clew::bridge {

/// While it lives, the signals that concern a supervisor are blocked and read from a descriptor:
/// those that ask for an end, and SIGCHLD, which only wakes a poll.
class SignalQueue {
 public:
  SignalQueue();
  ~SignalQueue();
  SignalQueue(const SignalQueue&) = delete;
  SignalQueue& operator=(const SignalQueue&) = delete;

  int descriptor() const { return descriptor_; }
  /// The last signal that asks for an end, or 0.
  int take();

 private:
  sigset_t set_{};
  sigset_t before_{};
  int descriptor_ = -1;
};

}  // namespace clew::bridge
