// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <poll.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "line/link.hpp"
#include "recorder/recorder_process.hpp"
#include "run/run_report.hpp"
#include "supervisor/child_process.hpp"

namespace clew::bridge {

/// The supervisor's side of the recorder: a process that may die and come back. What components
/// wrote is handed on as it came, and kept until it is in a closed chunk of the file; a recorder
/// that comes back reads its file and gets again what is kept. Never waits for the recorder.
class RecorderClient {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// With `drops`, samples are dropped rather than kept when too much waits for the recorder: the
  /// run does not wait for it.
  RecorderClient(RecordingOrder order, ChildCommand command, bool drops);

  /// Starts the process.
  core::Result<void> start(Time now);
  /// The recorder has reported.
  void welcome(std::unique_ptr<Link> link, Time now);
  /// Takes what a component spooled: all of it is of ticks before `end_tick`.
  void add(std::string spool, std::uint64_t end_tick);
  /// No more will be added: the recorder shall finish the file. `aborted`: why the run has no
  /// outcome; empty if it has one.
  void end(const RecordingEnd& end);
  /// Receives, sends what the line takes, and brings the recorder back if it has died or does not
  /// report.
  void serve(Time now);
  /// What to poll; none while there is no line.
  std::optional<pollfd> descriptor() const;

  bool ready() const { return account_ || (link_ && reads_samples_); }
  /// Ticks below this one may be started: so many ahead of what is in closed chunks that what is
  /// kept stays small. All, if the run does not wait for the recorder, or has none any more.
  std::uint64_t credit() const;
  /// How it went, once it has ended.
  const std::optional<RecordingAccount>& account() const { return account_; }
  std::uint32_t restarts() const { return restarts_; }
  /// Lines for the log since the last call.
  std::vector<std::string> take_lines() { return std::exchange(lines_, {}); }

 private:
  struct Batch {
    std::string spool;
    std::uint64_t end_tick = 0;
  };

  void receive(Time now);
  void send(Time now);
  void forget_durable();
  void lose();
  void restart(Time now);
  void fail(const std::string& why);

  RecordingOrder order_;
  ChildCommand command_;
  bool drops_;
  std::optional<ChildProcess> child_;
  std::unique_ptr<Link> link_;
  bool reads_samples_ = false;
  Time heard_at_{};
  std::deque<Batch> kept_;  ///< in the order of arrival
  std::size_t kept_bytes_ = 0;
  std::size_t unsent_bytes_ = 0;
  std::size_t next_ = 0;  ///< in kept_: the first that was not sent as a whole
  std::size_t sent_of_next_ = 0;
  bool blocked_ = false;  ///< the line took no more
  Time sent_at_{};
  Kept progress_;
  std::uint64_t durable_at_death_ = 0;
  std::uint32_t deaths_in_place_ = 0;
  std::uint32_t restarts_ = 0;
  bool ended_ = false;
  std::string ending_;  ///< the payload of kRecordingEnd
  bool end_sent_ = false;
  std::optional<RecordingAccount> account_;
  std::vector<std::string> lines_;
};

}  // namespace clew::bridge
