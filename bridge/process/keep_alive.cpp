// SPDX-License-Identifier: Apache-2.0
#include "process/keep_alive.hpp"

#include <chrono>
#include <utility>

namespace clew::bridge {
namespace {

constexpr auto kBeat = std::chrono::milliseconds(100);

}  // namespace

KeepAlive::KeepAlive(Link& link, std::string doing)
    : link_(link), doing_(std::move(doing)), thread_([this] { run(); }) {}

KeepAlive::~KeepAlive() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  ending_.notify_one();
  thread_.join();
}

void KeepAlive::run() {
  std::unique_lock lock(mutex_);
  while (!ended_) {
    link_.send(FrameType::kPreparing, Text{doing_});
    ending_.wait_for(lock, kBeat, [this] { return ended_; });
  }
}

}  // namespace clew::bridge
