// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "line/link.hpp"

namespace clew::bridge {

/// Reports, while it lives, that the process lives, and with what it is busy: reading a large world
/// or a long recording takes longer than a process may be silent.
class Heartbeat {
 public:
  /// `doing`: a sentence for whoever waits. `link` must outlive this.
  Heartbeat(Link& link, std::string doing);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

 private:
  void run();

  Link& link_;
  const std::string doing_;
  std::mutex mutex_;
  std::condition_variable ending_;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace clew::bridge
