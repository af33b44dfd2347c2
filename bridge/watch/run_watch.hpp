// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "dds/participant.hpp"
#include "line/frames.hpp"
#include "line/link.hpp"
#include "line/wake_up.hpp"
#include "wire/sample.hpp"

namespace clew::bridge {

/// Asks at the other end of a run's line what the run is, as somebody who only looks on. Refused: a
/// run of other message types, and one without processes.
core::Result<Assignment> ask_what_runs(Link& line, std::chrono::steady_clock::time_point deadline);

/// A live run as somebody sees it who only looks on: what the run is made of, and the samples that
/// its components write. It holds up nothing: what it does not take in time, it loses. Only
/// `event`, which tells what happens once, comes for certain; a watch that is stopped holds up
/// recover for the length of its lease.
class RunWatch : private DiscoveryListener {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Asks the run that `run` is, the number of its domain or its name, what it is, trying until
  /// `deadline`, and listens to all its topics. Refused: no such run, and one of other message
  /// types.
  static core::Result<std::unique_ptr<RunWatch>> join(const std::string& run, Time deadline);
  ~RunWatch() override;

  /// What the run is: its bundle, domain, identity and pace.
  const Assignment& run() const { return run_; }
  /// Whether the run goes on; asks its line, and does not wait.
  bool goes_on();

  /// Waits until something has come, one of `descriptors` can be read, or the time is over.
  void wait(std::vector<int> descriptors, std::chrono::nanoseconds most) const;
  /// What has come since the last call, of each topic in order.
  std::vector<Sample> take();
  /// What the run has logged since it was joined, or the last call.
  std::vector<std::string> take_notices() { return std::exchange(notices_, {}); }
  /// Samples that came faster than they were taken, and were dropped.
  std::uint64_t dropped() const;

 private:
  /// The reader's side of one topic.
  class TopicListener : public SampleListener {
   public:
    void on_sample(std::string_view cdr, const RemoteEndpoint* writer) override {
      if (writer != nullptr) watch_->keep(topic_, cdr, *writer);
    }

   private:
    friend class RunWatch;
    RunWatch* watch_ = nullptr;
    domain::Topic topic_ = domain::Topic::kCommand;
  };

  explicit RunWatch(int socket) : line_(socket) {}
  core::Result<void> listen();
  void keep(domain::Topic topic, std::string_view cdr, const RemoteEndpoint& writer);
  void on_participants(const std::set<std::string>&) override {}
  void on_matched(const RemoteEndpoint&) override {}
  void on_unmatched(const RemoteEndpoint&) override {}
  void on_incompatible_qos(const std::string&, bool, const std::string&) override {}
  void on_inconsistent_type(const RemoteEndpoint&) override {}

  Link line_;
  Assignment run_;
  std::vector<std::string> notices_;
  WakeUp arrived_;
  mutable std::mutex mutex_;
  std::vector<Sample> samples_;
  std::size_t bytes_ = 0;
  std::uint64_t dropped_ = 0;
  std::array<TopicListener, domain::kTopicCount> listeners_;
  std::unique_ptr<Participant> participant_;
  std::array<std::unique_ptr<SampleReader>, domain::kTopicCount> readers_;  ///< closed first
};

}  // namespace clew::bridge
