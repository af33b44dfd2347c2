// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "component/start_barrier.hpp"
#include "line/wake_up.hpp"
#include "replay/fed_component.hpp"
#include "replay/topic_publisher.hpp"
#include "runtime/component.hpp"
#include "vendors/third_party_environment.hpp"

namespace clew::bridge {

/// Who listens to a replay on the wire, as discovery tells, and the programs started for that.
class Audience {
 public:
  Audience();

  StartBarrier& barrier() { return barrier_; }
  const StartBarrier& barrier() const { return barrier_; }
  /// Rings when there is news.
  const WakeUp& wake() const { return wake_; }

  /// Expects a reader of each topic, whoever it belongs to; before its writer is created.
  void expect_readers(const runtime::TopicSet& topics, const TopicNames& names = {});
  /// Starts programs that read: command lines of a shell, which are told what a run's components
  /// are. An error says which one cannot be started.
  core::Result<void> start_readers(const std::vector<std::string>& commands,
                                   const WireSettings& settings);
  /// Ends them; those that may end in order are first given the time to do so by themselves.
  void end_readers(bool orderly);

  /// Whether somebody came or went since the last call.
  bool news() { return news_.exchange(false); }
  /// Who was turned away and why, since the last call.
  std::vector<std::string> take_notices();
  /// What makes it impossible that everybody comes.
  std::optional<std::string> fatal() const;

 private:
  WakeUp wake_;
  std::atomic<bool> news_{false};
  mutable std::mutex mutex_;
  std::vector<std::string> notices_;
  std::optional<std::string> fatal_;
  StartBarrier barrier_;
  std::optional<ThirdPartyEnvironment> environment_;  ///< of the programs started
  std::vector<Member> readers_;
};

}  // namespace clew::bridge
