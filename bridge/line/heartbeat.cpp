// SPDX-License-Identifier: Apache-2.0
#include "line/heartbeat.hpp"

#include <utility>

#include "run/limits.hpp"

namespace clew::bridge {

Heartbeat::Heartbeat(std::function<void()> beat)
    : beat_(std::move(beat)), thread_([this] { run(); }) {}

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
    lock.unlock();
    beat_();
    lock.lock();
    ending_.wait_for(lock, kHeartbeatPeriod, [this] { return ended_; });
  }
}

}  // namespace clew::bridge
