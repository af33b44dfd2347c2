// SPDX-License-Identifier: Apache-2.0
#include "run/composed_run.hpp"

#include <chrono>
#include <cstring>
#include <optional>
#include <thread>
#include <utility>

#include "recording/run_hash.hpp"
#include "run/allocations.hpp"
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
      const bool recorded = recording_ != nullptr && recording_->wants_samples();
      if (account_.wants_bytes() || recorded) {
        cdr = std::get<constant.kIndex>(codecs_).encode(message);
      }
      account_.add(message, cdr);
      if (!recorded) return;
      const auto added = recording_->add({topic, message.stamp.tick, message.stamp.sequence, cdr});
      if (added.ok()) return;
      failure_ = "the recording failed: " + added.error().text();
      recording_ = nullptr;
    });
  }

  /// Hands on the states of nodes that are about to step `tick`, if they are wanted.
  void checkpoint(const std::vector<runtime::NodeSuccession>& nodes, std::uint64_t tick) {
    if (recording_ == nullptr || tick == 0 || tick % kTicksPerCheckpoint != 0) return;
    if (!recording_->wants_states()) return;
    for (const runtime::NodeSuccession& node : nodes) {
      recording_->add_state({node.name(), tick, node.save()});
    }
  }

  SampleSink* recording() const { return recording_; }
  const SampleAccount& account() const { return account_; }
  /// Why the recording was given up; empty if it was not.
  const std::string& failure() const { return failure_; }

 private:
  Codecs codecs_;
  SampleAccount account_;
  SampleSink* recording_;
  std::string failure_;
};

/// Tells a profile what comes when, besides, while there is one.
class ProfiledObserver : public runtime::SampleObserver, runtime::PartObserver {
 public:
  ProfiledObserver(runtime::SampleObserver& observer, RunProfile* const& profile)
      : observer_(observer), profile_(profile) {}

  void on_output(runtime::Topic topic, const domain::Messages& messages) override {
    tell([&](const auto& now) { profile_->begin_sample(topic, now); });
    observer_.on_output(topic, messages);
    tell([&](const auto& now) { profile_->end_sample(now); });
  }
  runtime::PartObserver* parts() override { return profile_ == nullptr ? nullptr : this; }

  void begin_tick(std::uint64_t tick) {
    tell([&](const auto& now) { profile_->begin_tick(tick, now); });
  }
  void end_tick() {
    tell([&](const auto& now) { profile_->end_tick(now); });
  }

 private:
  void begin_part(std::string_view name) override {
    tell([&](const auto& now) { profile_->begin_part(name, now); });
  }
  void end_part() override {
    tell([&](const auto& now) { profile_->end_part(now); });
  }

  /// What the profile itself allocates does not count.
  template <typename Call>
  void tell(Call call) {
    if (profile_ == nullptr) return;
    const std::uint64_t before = allocation_count();
    call(RunProfile::Moment{Clock::now(), before - own_});
    own_ += allocation_count() - before;
  }

  runtime::SampleObserver& observer_;
  RunProfile* const& profile_;
  std::uint64_t own_ = 0;
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A composed run under way.
class ComposedLoop {
 public:
  ComposedLoop(const runtime::RunPlan& plan, ComposedStart start, const ComposedLayout& layout,
               SampleSink* recording, const ProgressDisplay& display, ComposedOrders* orders)
      : layout_(layout),
        display_(display),
        orders_(orders),
        started_at_(start.started_at),
        first_tick_(start.next_tick),
        bookkeeper_(std::move(start.account), recording),
        profile_(layout.profile),
        profiled_(bookkeeper_, profile_),
        executor_(std::move(start.nodes), observer(), start.next_tick, std::move(start.messages)),
        tick_s_(plan.graph.tick_s),
        clock_(layout.pace, layout.pace_factor, plan.graph.tick_s) {
    clock_.start(displayed_at_, start.next_tick);
  }

  RunReport run() {
    look(std::chrono::milliseconds(0));
    while (goes_on() && report_.aborted.empty()) {
      if (orders_ != nullptr && !orders_->may_begin(executor_.next_tick())) {
        look(kSignalPeriod);
        clock_.start(Clock::now(), executor_.next_tick());
        continue;
      }
      if (is_long_before_next_tick()) {
        std::this_thread::sleep_for(kSignalPeriod);
        look(std::chrono::milliseconds(0));
        continue;
      }
      step();
      const auto now = Clock::now();
      if (now >= next_look_) look(std::chrono::milliseconds(0));
      if (display_ && now - displayed_at_ >= kDisplayPeriod) {
        displayed_at_ = now;
        rate_.note(executor_.next_tick(), displayed_at_);
        display_(statistics(), rate_.per_s());
      }
    }
    return finish();
  }

 private:
  const RunStatistics& statistics() const { return bookkeeper_.account().statistics(); }
  bool goes_on() const {
    return !statistics().truth || statistics().truth->outcome == domain::Outcome::kRunning;
  }

  /// At a slow pace, orders and signals come between two ticks.
  bool is_long_before_next_tick() const {
    return !clock_.is_free() && clock_.due(executor_.next_tick()) > Clock::now() + kSignalPeriod;
  }

  /// With orders, somebody may ask where the time goes later on.
  runtime::SampleObserver* observer() {
    const bool may_be_profiled = profile_ != nullptr || orders_ != nullptr;
    return may_be_profiled ? static_cast<runtime::SampleObserver*>(&profiled_) : &bookkeeper_;
  }

  void step() {
    if (!clock_.is_free()) std::this_thread::sleep_until(clock_.due(executor_.next_tick()));
    bookkeeper_.checkpoint(executor_.nodes(), executor_.next_tick());
    profiled_.begin_tick(executor_.next_tick());
    executor_.step();
    profiled_.end_tick();
    if (executor_.next_tick() == first_tick_ + 1) rate_.note(executor_.next_tick(), Clock::now());
    if (orders_ != nullptr) {
      orders_->note(executor_.next_tick() - 1, executor_.nodes(), executor_.messages());
    }
    if (layout_.on_record_error == OnRecordError::kStop) report_.aborted = bookkeeper_.failure();
  }

  /// Looks what somebody wants of the run.
  void look(std::chrono::milliseconds patience) {
    if (orders_ != nullptr) {
      orders_->serve(executor_.next_tick(), executor_.nodes(), bookkeeper_.recording(), patience);
      if (report_.aborted.empty()) report_.aborted = orders_->stopped();
      if (layout_.profile == nullptr) profile_ = orders_->profile();
      if (const auto factor = orders_->take_pace()) {
        clock_ = TickClock::at_pace(*factor, tick_s_);
        clock_.start(Clock::now(), executor_.next_tick());
      }
    }
    next_look_ = Clock::now() + kSignalPeriod;
    report_.interrupted_by = signals_.take();
    if (report_.interrupted_by == 0) return;
    report_.aborted = "interrupted by signal " + std::to_string(report_.interrupted_by) + " (" +
                      ::strsignal(report_.interrupted_by) + ")";
  }

  RunReport finish() {
    report_.statistics = statistics();
    report_.wall_s = seconds_since(started_at_);
    rate_.note(executor_.next_tick(), Clock::now());
    report_.ticks_per_s = rate_.per_s();
    if (layout_.hash && report_.aborted.empty()) {
      report_.hash = run_hash(bookkeeper_.account().chains());
    }
    return report_;
  }

  const ComposedLayout& layout_;
  const ProgressDisplay& display_;
  ComposedOrders* const orders_;
  const Clock::time_point started_at_;
  const std::uint64_t first_tick_;
  Bookkeeper bookkeeper_;
  RunProfile* profile_;  ///< null: nobody asks where the time goes
  ProfiledObserver profiled_;
  runtime::ComposedExecutor executor_;
  Clock::time_point displayed_at_ = Clock::now();
  const double tick_s_;
  TickClock clock_;
  Clock::time_point next_look_ = displayed_at_;
  EndSignals signals_;
  RunReport report_;
  TickRate rate_;
};

}  // namespace

RunProfile profile_of(const runtime::RunPlan& plan) {
  std::vector<RunProfile::Writer> writers;
  for (const runtime::GraphStage& stage : plan.graph.stages) {
    writers.push_back({stage.info->name, stage.ports.output_order});
  }
  return RunProfile(writers);
}

core::Result<RunReport> run_composed(const runtime::RunPlan& plan, const ComposedLayout& layout,
                                     SampleSink* recording, const ProgressDisplay& display,
                                     ComposedOrders* orders) {
  const auto started_at = Clock::now();
  auto nodes = runtime::make_nodes(plan);
  if (!nodes.ok()) return nodes.error();
  ComposedStart start{runtime::alone(std::move(nodes).value()),
                      0,
                      {},
                      SampleAccount(layout.hash, false),
                      started_at};
  return run_composed(plan, std::move(start), layout, recording, display, orders);
}

core::Result<RunReport> run_composed(const runtime::RunPlan& plan, ComposedStart start,
                                     const ComposedLayout& layout, SampleSink* recording,
                                     const ProgressDisplay& display, ComposedOrders* orders) {
  return ComposedLoop(plan, std::move(start), layout, recording, display, orders).run();
}

}  // namespace clew::bridge
