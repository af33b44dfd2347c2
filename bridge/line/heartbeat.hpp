// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace clew::bridge {

/// Reports, while it lives, that the process lives, from a thread of its own: reading a large world
/// or a long recording, or a step that plans, takes longer than a process may be silent.
class Heartbeat {
 public:
  /// `beat` is called at once and then every kHeartbeatPeriod, on the thread; it must not wait.
  explicit Heartbeat(std::function<void()> beat);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

 private:
  void run();

  const std::function<void()> beat_;
  std::mutex mutex_;
  std::condition_variable ending_;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace clew::bridge
