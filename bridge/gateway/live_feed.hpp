// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "line/link.hpp"
#include "recording/run_description.hpp"
#include "run/end_signals.hpp"
#include "run/run_page.hpp"
#include "run/sample_account.hpp"
#include "run/sample_sink.hpp"
#include "run/shown_states.hpp"
#include "supervisor/child_process.hpp"

namespace clew::bridge {

/// What a gateway says when viewers have all.
inline constexpr char kPassedOn[] = "passed on";

/// The run's side of its gateway: a process that gets what the recorder gets, and that the run
/// never waits for. What it does not take in time is dropped and counted.
class LiveFeed {
 public:
  /// Starts `words`, a program with its arguments, and tells it its end of the socket and `port`
  /// (0: any free one). `name` is what the page shows; under `run` it finds the run when somebody
  /// commands it.
  static core::Result<std::unique_ptr<LiveFeed>> start(const std::vector<std::string>& words,
                                                       int port, const RunDescription& description,
                                                       const std::string& name,
                                                       const std::string& run);

  /// Takes what the gateway says of itself, without waiting. Refused: one that did not start.
  core::Result<void> poll();
  /// The same, and waits until the address is there.
  core::Result<void> wait_for_address();
  /// Where the page is; empty before the gateway has said it.
  const std::string& address() const { return address_; }
  /// Whether the gateway is there.
  bool goes_on();
  /// Takes what a component spooled. Does not wait.
  void add(std::string_view spool);
  /// Tells how the run ended, and waits until viewers have it all: for three seconds in which none
  /// gets anything, for thirty at most, and not once a signal asks for an end. False if one did.
  bool end(const std::string& how, EndSignals& signals);
  /// Until a signal asks for an end, or the gateway ends; then it is gone.
  void wait(EndSignals& signals);
  std::uint64_t dropped_batches() const { return dropped_batches_; }

 private:
  LiveFeed(std::unique_ptr<Link> link, ChildProcess child)
      : link_(std::move(link)), child_(std::move(child)) {}
  core::Result<void> take_address(const Frame& frame);
  void send();
  /// Waits until something comes or goes. False: it is too late, a signal asks for an end, or the
  /// gateway is gone.
  bool turn_until(std::chrono::steady_clock::time_point deadline, EndSignals& signals);

  std::unique_ptr<Link> link_;
  ChildProcess child_;
  std::chrono::steady_clock::time_point started_at_ = std::chrono::steady_clock::now();
  std::string address_;
  std::deque<std::string> waiting_;
  std::size_t waiting_bytes_ = 0;
  std::uint64_t dropped_batches_ = 0;
  bool asked_to_end_ = false;
};

/// Lets a page see what goes to another sink, or to none.
class FedSink : public SampleSink {
 public:
  FedSink(SampleSink* next, RunPage& page) : next_(next), page_(page) {}
  ~FedSink() override { page_.add(spool_); }

  core::Result<void> add(const SampleView& sample) override;
  bool wants_samples() const override {
    return page_.is_open() || (next_ != nullptr && next_->wants_samples());
  }
  bool wants_states() const override {
    return shown_states_.shows(next_tick_) || (next_ != nullptr && next_->wants_states());
  }
  void add_state(const SpooledState& state) override;
  void add_intervention(const domain::Intervention& intervention) override {
    page_.add_intervention(intervention);
    if (!intervention.changes.empty()) shown_states_.change_at(intervention.tick);
    if (next_ != nullptr) next_->add_intervention(intervention);
  }
  void add_incident(const domain::Incident& incident) override {
    page_.add(spooled(incident));
    if (next_ != nullptr) next_->add_incident(incident);
  }

 private:
  SampleSink* next_;
  RunPage& page_;
  std::string spool_;
  std::uint64_t next_tick_ = 0;  ///< behind that of the last sample
  ShownStates shown_states_;     ///< the page looks on from the first sample that it got
  std::chrono::steady_clock::time_point handed_on_at_{};
};

}  // namespace clew::bridge
