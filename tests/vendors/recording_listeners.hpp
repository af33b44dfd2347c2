// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "dds/participant.hpp"

namespace clew::bridge {

/// Long enough for a loaded machine; nothing waits for it to pass unless the test fails.
inline constexpr std::chrono::seconds kPatience{20};

/// Keeps what it is told, and lets a test wait until something has been told.
class DiscoveryRecord : public DiscoveryListener {
 public:
  struct Incompatibility {
    std::string topic;
    bool local_is_writer;
    std::string policy;
  };
  struct Events {
    std::set<std::string> participants;
    std::vector<RemoteEndpoint> matched;
    std::vector<RemoteEndpoint> unmatched;
    std::vector<Incompatibility> incompatible;
    std::vector<RemoteEndpoint> inconsistent;
  };

  void on_participants(const std::set<std::string>& names) override {
    change([&](Events& e) { e.participants = names; });
  }
  void on_matched(const RemoteEndpoint& remote) override {
    change([&](Events& e) { e.matched.push_back(remote); });
  }
  void on_unmatched(const RemoteEndpoint& remote) override {
    change([&](Events& e) { e.unmatched.push_back(remote); });
  }
  void on_incompatible_qos(const std::string& topic, bool local_is_writer,
                           const std::string& policy) override {
    change([&](Events& e) { e.incompatible.push_back({topic, local_is_writer, policy}); });
  }
  void on_inconsistent_type(const RemoteEndpoint& remote) override {
    change([&](Events& e) { e.inconsistent.push_back(remote); });
  }

  /// False if `condition` did not become true in time.
  bool wait_until(const std::function<bool(const Events&)>& condition) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return condition(events_); });
  }
  bool wait_for_matches(std::size_t count) {
    return wait_until([&](const Events& e) { return e.matched.size() >= count; });
  }
  Events events() {
    const std::lock_guard lock(mutex_);
    return events_;
  }

 private:
  template <typename F>
  void change(F f) {
    const std::lock_guard lock(mutex_);
    f(events_);
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  Events events_;
};

/// Keeps every sample, without the padding at its end if the size that was sent is told.
class SampleRecord : public SampleListener {
 public:
  void on_sample(std::string_view cdr, const RemoteEndpoint* writer) override {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !held_; });
    samples_.emplace_back(cdr);
    writers_.push_back(writer != nullptr ? writer->guid : "");
    changed_.notify_all();
  }

  /// Keeps the vendor's thread in on_sample until release().
  void hold() { set_held(true); }
  void release() { set_held(false); }

  bool wait_for(std::size_t count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return samples_.size() >= count; });
  }
  std::vector<std::string> samples() {
    const std::lock_guard lock(mutex_);
    return samples_;
  }
  std::vector<std::string> writers() {
    const std::lock_guard lock(mutex_);
    return writers_;
  }

 private:
  void set_held(bool held) {
    const std::lock_guard lock(mutex_);
    held_ = held;
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  bool held_ = false;
  std::vector<std::string> samples_;
  std::vector<std::string> writers_;
};

}  // namespace clew::bridge
