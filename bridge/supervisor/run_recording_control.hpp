// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <poll.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "recorder/recording_sink.hpp"
#include "run/run_report.hpp"
#include "supervisor/process_layout.hpp"
#include "supervisor/recorder_client.hpp"

namespace clew::bridge {

/// What a run does about its recording: hands on what was written, and decides what becomes of the
/// run when the recording fails.
class RunRecordingControl {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// With `drops`, nothing waits for the recorder, and what it cannot take is dropped.
  RunRecordingControl(const RecordingOrder& order, ChildCommand recorder, OnRecordError on_error,
                      bool drops);

  core::Result<void> start(Time now) { return client_.start(now); }
  void welcome(std::unique_ptr<Link> link, Time now) { client_.welcome(std::move(link), now); }
  /// As RecorderClient::add.
  void add(std::string spool, std::uint64_t end_tick) { client_.add(std::move(spool), end_tick); }
  /// Receives, sends and restarts, without waiting.
  void serve(Time now);
  std::optional<pollfd> descriptor() const { return client_.descriptor(); }

  bool ready() const { return client_.ready(); }
  /// Ticks below this one may be started.
  std::uint64_t credit() const { return client_.credit(); }
  /// Why the run cannot go on; empty if it can.
  const std::string& failure() const { return failure_; }
  /// Lines for the log since the last call.
  std::vector<std::string> take_lines() { return std::exchange(lines_, {}); }

  /// Nothing will be added any more.
  void end(const RecordingEnd& end) { client_.end(end); }
  bool ended() const { return client_.account().has_value(); }
  std::uint32_t restarts() const { return client_.restarts(); }
  /// How the recording went; gives the file its name.
  RecordingAccount finish() const;

 private:
  RecorderClient client_;
  const std::string path_;
  const bool overwrite_;
  const OnRecordError on_error_;
  bool told_ = false;
  std::string failure_;
  std::vector<std::string> lines_;
};

}  // namespace clew::bridge
