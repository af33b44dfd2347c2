// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "component/input_account.hpp"
#include "component/scan_watch.hpp"
#include "component/start_barrier.hpp"
#include "dds/participant.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// Its place among the checkpoints of a run that is under way.
inline constexpr char kObserverName[] = "observer";

/// Reads the topics that third-party components write, so that their samples are hashed,
/// counted and recorded like those of components that keep their own account. If one of them
/// steers, it reads scans and odometry, too, since nobody of ours sees what the robot is driven by.
class ThirdPartyObserver {
 public:
  /// Null if every component of the plan is ours.
  static core::Result<std::unique_ptr<ThirdPartyObserver>> create(const runtime::RunPlan& plan,
                                                                  Assignment assignment);

  bool ready() const { return barrier_->missing().empty(); }
  std::vector<std::string> missing() const { return barrier_->missing(); }
  /// Takes over what has come. What is spooled is of ticks before ticks().
  void poll();
  std::uint64_t ticks() const { return progress_.ticks; }
  /// The same of topics that it reads alone.
  std::uint64_t ticks_of(const runtime::TopicSet& topics) const {
    return account_->ticks_of(topics);
  }
  /// How many ticks all the components that it reads have done: ` control 57`.
  std::string ticks_text() const { return ' ' + stages_ + ' ' + std::to_string(ticks()); }
  bool finished(std::uint64_t last_tick) const { return account_->finished(last_tick).has_value(); }
  const RunStatistics& statistics() const { return progress_.statistics; }
  std::uint64_t refused_samples() const { return progress_.refused_samples; }
  std::map<std::string, core::Hash128> chains() const;
  void spool() { account_->spool(); }
  std::string take_spooled() { return std::exchange(spooled_, {}); }
  std::vector<std::string> take_notices();
  /// What is to be said of the sensor since the last call.
  std::vector<ScanWatch::News> look_at_sensor(ScanWatch::Time now);
  std::optional<std::string> fatal() const;

 private:
  ThirdPartyObserver() = default;
  core::Result<void> watch_scans(const runtime::RunPlan& plan, Assignment assignment);

  std::string stages_;  ///< that it reads: `control`
  mutable std::mutex mutex_;
  std::vector<std::string> notices_;
  std::vector<ScanWatch::News> sensor_news_;
  std::optional<std::string> fatal_;
  Progress progress_;
  std::string spooled_;
  std::unique_ptr<StartBarrier> barrier_;
  std::unique_ptr<Participant> participant_;
  std::unique_ptr<InputAccount> account_;  // closed before the participant
  std::optional<ScanWatch> scan_watch_;    ///< with the mutex held
  bool realtime_ = false;
  std::uint64_t scans_seen_ = 0;
  std::unique_ptr<InputAccount> scans_;  // closed before the watch
};

}  // namespace clew::bridge
