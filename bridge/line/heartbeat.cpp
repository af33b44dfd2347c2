// SPDX-License-Identifier: Apache-2.0
#include "line/heartbeat.hpp"

#include <chrono>
#include <utility>

#include "run/limits.hpp"

namespace clew::bridge {
Heartbeat::Heartbeat(Link& link, std::string doing)
    : link_(link), doing_(std::move(doing)), thread_([this] { run(); }) {}

Heartbeat::~Heartbeat() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  ending_.notify_one();
  thread_.join();
}

void Heartbeat::run() {
  std::unique_lock lock(mutex_);
  while (!ended_) {
    link_.send(FrameType::kPreparing, Text{doing_});
    ending_.wait_for(lock, kHeartbeatPeriod, [this] { return ended_; });
  }
}

}  // namespace clew::bridge
