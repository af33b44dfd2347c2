// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>

namespace clew::bench {

/// While it lives, SIGINT and SIGTERM are noted instead of ending this process. One at a time.
class NotedSignals {
 public:
  NotedSignals();
  ~NotedSignals();
  NotedSignals(const NotedSignals&) = delete;
  NotedSignals& operator=(const NotedSignals&) = delete;

  /// The signal that came; 0: none.
  static int noted();
  /// Waits so many seconds, or until one comes. False if one has come.
  static bool wait(double seconds);

 private:
  struct sigaction interrupt_ {};
  struct sigaction terminate_ {};
};

}  // namespace clew::bench
