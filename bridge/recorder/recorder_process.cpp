// SPDX-License-Identifier: Apache-2.0
#include "recorder/recorder_process.hpp"

#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <utility>

#include "line/heartbeat.hpp"
#include "line/link.hpp"
#include "log/log.hpp"
#include "recorder/black_box.hpp"
#include "run/limits.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using Clock = std::chrono::steady_clock;
using core::Error;
using core::Result;

class Recorder {
 public:
  Recorder(Link& link, RunSink& sink) : link_(link), sink_(sink) {}

  /// Returns true after an orderly end.
  bool run() {
    while (true) {
      const auto now = Clock::now();
      if (now >= next_report_) report(now);
      if (now >= next_write_ahead_) {
        next_write_ahead_ = now + kWriteAheadPeriod;
        note(sink_.write_ahead());
      }
      if (!failure_.empty()) return give_up();
      pollfd descriptor{link_.socket(), link_.poll_events(), 0};
      ::poll(&descriptor, 1, static_cast<int>(kRecorderReportPeriod.count()));
      if (!link_.flush() || !link_.receive()) return false;
      while (auto frame = link_.next()) {
        if (frame->type == FrameType::kSamples) record(frame->payload);
        if (frame->type == FrameType::kRecordingEnd && failure_.empty()) {
          const auto end = frame->as<RecordingEnd>().value_or(RecordingEnd{});
          return tell(sink_.close({end.aborted, true, end.run_hash}));
        }
      }
      if (sink_.kept().ticks >= reported_ + kRecorderReportTicks) report(now);
    }
  }

 private:
  void record(const std::string& spool) {
    const SpoolVisitor visitor{
        [this](const SampleView& sample) { add(sample); },
        [this](const SpooledState& state) { sink_.add_state(state); },
        [this](const domain::Intervention& intervention) { sink_.add_intervention(intervention); },
        [this](const domain::Incident& incident) { sink_.add_incident(incident); }};
    const bool whole = for_each_spooled(spool, visitor);
    if (!whole && failure_.empty()) failure_ = "a component sent a damaged spool";
  }

  void add(const SampleView& sample) {
    if (failure_.empty()) note(sink_.add(sample));
  }

  void note(const Result<void>& result) {
    if (!result.ok() && failure_.empty()) failure_ = result.error().text();
  }

  void report(Clock::time_point now) {
    const Kept kept = sink_.kept();
    reported_ = kept.ticks;
    link_.post(FrameType::kKept, kept);
    next_report_ = now + kRecorderReportPeriod;
  }

  bool tell(RecordingAccount account) {
    link_.post(FrameType::kRecorded, std::move(account));
    return link_.flush_until(Clock::now() + kRecorderStartTimeout);
  }

  bool give_up() {
    RecordingAccount account;
    account.failure = failure_;
    tell(std::move(account));
    return false;
  }

  Link& link_;
  RunSink& sink_;
  std::string failure_;
  std::uint64_t reported_ = 0;
  Clock::time_point next_report_{};
  Clock::time_point next_write_ahead_{};
};

/// The assignment that follows a hello; an error if the supervisor goes away before.
Result<RecorderAssignment> take_assignment(Link& link) {
  link.post(FrameType::kHello, Hello{kRecorderName, ::getpid(), std::string(idl_fingerprint())});
  const auto frame = link.wait_for_frame(Clock::now() + kAssignmentTimeout);
  if (!frame.ok()) return frame.error();
  auto assignment = frame->as<RecorderAssignment>();
  if (frame->type == FrameType::kRecord && assignment) return *std::move(assignment);
  return Error{"the run has no place for a recorder"};
}

Result<std::unique_ptr<RunSink>> sink_for(const RecorderAssignment& assignment) {
  const std::string& path = assignment.order.path;
  if (assignment.again && mcap::OutputFile::temporary_name(path) == path) {
    return Error{"what the recorder wrote there before it died cannot be read back", path};
  }
  return open_sink(assignment.order, assignment.least_ticks);
}

/// The same, and lets the run know meanwhile that it takes its time.
Result<std::unique_ptr<RunSink>> prepared_sink(const RecorderAssignment& assignment, Link& link) {
  const Heartbeat alive(
      [&] { link.post(FrameType::kPreparing, Text{"the recorder still reads its file"}); });
  return sink_for(assignment);
}

int complain(const Error& error) {
  logs::error("{}", error.text());
  return 1;
}

}  // namespace

core::Result<std::unique_ptr<RunSink>> open_sink(const RecordingOrder& order,
                                                 std::uint64_t least_ticks) {
  if (order.keep_last_s > 0.0) {
    auto box = BlackBox::go_on(order, least_ticks);
    if (!box.ok()) return box.error();
    return std::unique_ptr<RunSink>(std::move(box).value());
  }
  auto sink = RecordingSink::go_on(order, least_ticks);
  if (!sink.ok()) return sink.error();
  return std::unique_ptr<RunSink>(std::move(sink).value());
}

int run_recorder_process(int domain, double connect_timeout_s) {
  const auto patience = std::chrono::duration<double>(connect_timeout_s);
  const auto socket =
      Link::connect(domain, Clock::now() + std::chrono::duration_cast<Clock::duration>(patience));
  if (!socket.ok()) return complain(socket.error());
  Link link(*socket);
  const auto assignment = take_assignment(link);
  if (!assignment.ok()) return complain(assignment.error());
  auto sink = prepared_sink(*assignment, link);
  if (!sink.ok()) {
    RecordingAccount account;
    account.failure = sink.error().text();
    link.post(FrameType::kRecorded, std::move(account));
    link.flush_until(Clock::now() + kEndGrace);
    return 1;
  }
  return Recorder(link, **sink).run() ? 0 : 1;
}

}  // namespace clew::bridge
