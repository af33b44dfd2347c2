// SPDX-License-Identifier: Apache-2.0
#include "run/composed_run.hpp"

#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

#include "recording/run_hash.hpp"
#include "run/end_signals.hpp"
#include "run/limits.hpp"
#include "run/sample_account.hpp"
#include "run/tick_clock.hpp"
#include "run/tick_rate.hpp"

namespace clew::bridge {
namespace {

using Clock = std::chrono::steady_clock;

/// Keeps the account of every node, and passes the samples on to the recording.
class Bookkeeper : public runtime::SampleObserver {
 public:
  Bookkeeper(SampleAccount account, SampleSink* recording)
      : account_(std::move(account)), recording_(recording) {}

  void on_output(runtime::Topic topic, const domain::Messages& messages) override {
    domain::visit_topic(topic, [&](auto constant) {
      const auto& message = std::get<constant.kIndex>(messages);
      std::string_view cdr;
      if (account_.wants_bytes() || recording_ != nullptr) {
        cdr = std::get<constant.kIndex>(codecs_).encode(message);
      }
      account_.add(message, cdr);
      if (recording_ == nullptr) return;
      const auto added = recording_->add({topic, message.stamp.tick, message.stamp.sequence, cdr});
      if (added.ok()) return;
      failure_ = "the recording failed: " + added.error().text();
      recording_ = nullptr;
    });
  }

  /// Hands on the states of nodes that are about to step `tick`, if they are wanted.
  void checkpoint(const std::vector<runtime::Node>& nodes, std::uint64_t tick) {
    if (recording_ == nullptr || tick == 0 || tick % kTicksPerCheckpoint != 0) return;
    if (!recording_->wants_states()) return;
    for (const runtime::Node& node : nodes) {
      recording_->add_state({node.name(), tick, node.save()});
    }
  }

  const SampleAccount& account() const { return account_; }
  /// Why the recording was given up; empty if it was not.
  const std::string& failure() const { return failure_; }

 private:
  Codecs codecs_;
  SampleAccount account_;
  SampleSink* recording_;
  std::string failure_;
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

core::Result<RunReport> run_composed(const runtime::RunPlan& plan, const ComposedLayout& layout,
                                     SampleSink* recording, const ProgressDisplay& display) {
  const auto started_at = Clock::now();
  auto nodes = runtime::make_nodes(plan);
  if (!nodes.ok()) return nodes.error();
  ComposedStart start{
      std::move(nodes).value(), 0, {}, SampleAccount(layout.hash, false), started_at};
  return run_composed(plan, std::move(start), layout, recording, display);
}

core::Result<RunReport> run_composed(const runtime::RunPlan& plan, ComposedStart start,
                                     const ComposedLayout& layout, SampleSink* recording,
                                     const ProgressDisplay& display) {
  Bookkeeper bookkeeper(std::move(start.account), recording);
  runtime::ComposedExecutor executor(std::move(start.nodes), &bookkeeper, start.next_tick,
                                     std::move(start.messages));
  TickClock clock(layout.pace, layout.pace_factor, plan.graph.tick_s);
  EndSignals signals;

  RunReport report;
  TickRate rate;
  auto displayed_at = Clock::now();
  auto next_look = displayed_at;
  clock.start(displayed_at, start.next_tick);
  const RunStatistics& statistics = bookkeeper.account().statistics();
  const auto goes_on = [&] {
    return !statistics.truth || statistics.truth->outcome == domain::Outcome::kRunning;
  };
  while (goes_on() && report.aborted.empty()) {
    if (!clock.is_free()) std::this_thread::sleep_until(clock.due(executor.next_tick()));
    bookkeeper.checkpoint(executor.nodes(), executor.next_tick());
    executor.step();
    if (executor.next_tick() == start.next_tick + 1) rate.note(executor.next_tick(), Clock::now());
    if (layout.on_record_error == OnRecordError::kStop) report.aborted = bookkeeper.failure();
    const auto now = Clock::now();
    if (now >= next_look) {
      next_look = now + kSignalPeriod;
      report.interrupted_by = signals.take();
    }
    if (report.interrupted_by != 0) {
      report.aborted = "interrupted by signal " + std::to_string(report.interrupted_by) + " (" +
                       ::strsignal(report.interrupted_by) + ")";
    }
    if (display && now - displayed_at >= kDisplayPeriod) {
      displayed_at = now;
      rate.note(executor.next_tick(), displayed_at);
      display(statistics, rate.per_s());
    }
  }

  report.statistics = statistics;
  report.wall_s = seconds_since(start.started_at);
  rate.note(executor.next_tick(), Clock::now());
  report.ticks_per_s = rate.per_s();
  if (layout.hash && report.aborted.empty()) report.hash = run_hash(bookkeeper.account().chains());
  return report;
}

}  // namespace clew::bridge
