// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "component/busy_thread.hpp"
#include "component/command_gate.hpp"
#include "component/input_history.hpp"
#include "component/scan_watch.hpp"
#include "component/start_barrier.hpp"
#include "dds/participant.hpp"
#include "line/frames.hpp"
#include "run/sample_account.hpp"
#include "run/step_times.hpp"
#include "run/tick_clock.hpp"
#include "runtime/input_buffer.hpp"
#include "runtime/node_succession.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// A node on the wire: samples come in on the vendor's threads, the last input of a tick steps the
/// node in the thread that brought it, and outputs go out at once. A write that the vendor does not
/// take waits in a queue for poll(), since a receive thread must never wait for acknowledgements
/// that only it can process.
class NodeHost {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Calls come from any thread, with the host's lock held: they must not wait, and not call back.
  struct Handlers {
    std::function<void(std::string)> on_notice;
    std::function<void(std::string)> on_fatal;
    /// Every few ticks, and when the run's outcome is known.
    std::function<void(const Progress&)> on_progress;
    /// At every multiple of the checkpoint period.
    std::function<void(const Checkpoint&)> on_checkpoint;
    /// Samples for the recording, as SampleAccount spools them.
    std::function<void(std::string)> on_spooled;
    /// A successor has taken over.
    std::function<void(const TookOver&)> on_took_over = nullptr;
    /// It has noticed something of others.
    std::function<void(const domain::Incident&)> on_incident = nullptr;
  };

  /// Of the plan it needs the duration of a tick, and the arrangement of beams that scans must
  /// have.
  NodeHost(runtime::NodeSuccession node, const Assignment& assignment, const runtime::RunPlan& plan,
           Handlers handlers);
  ~NodeHost();
  NodeHost(const NodeHost&) = delete;
  NodeHost& operator=(const NodeHost&) = delete;

  /// Creates the endpoints. `barrier` and `participant` must outlive the host.
  core::Result<void> open(Participant& participant, const StartBarrier& barrier);

  /// Goes on from a checkpoint instead of tick 0; before open().
  core::Result<void> restore(const Checkpoint& checkpoint);
  /// Writes again what was written last before the checkpoint; after open().
  void repeat_last_outputs(const Checkpoint& checkpoint);
  /// Lets the stage that starts ticks begin.
  void go(Time now);
  /// Keeps the inputs of each tick there; before open().
  void keep_inputs(InputHistory history) { history_.emplace(std::move(history)); }
  /// Somebody will take the node's place at this tick: in lockstep it is not begun before
  /// take_successor().
  void expect_successor(std::uint64_t tick);
  /// Feeds the successor what its stage has seen, and adds it. From any thread; the node steps on
  /// meanwhile. An error: the inputs are not kept any more.
  core::Result<void> take_successor(runtime::Successor successor);
  /// Nobody takes the node's place at this tick: it stays as it is.
  void forget_successor(std::uint64_t tick);
  /// Starts no tick from the next one on, but not before `tick`; returns which.
  std::uint64_t hold(std::uint64_t tick);
  /// In real time: takes no delayed input any more, as if each were late. The robot comes to rest.
  void rest();
  /// In real time: takes every second delayed input only, as if the others were late; or all again.
  void slow(bool slowly);
  /// Whether the robot stands still since rest().
  bool has_come_to_rest() const;
  /// Ends a hold, and a rest.
  void release(Time now);
  /// Starts ticks at another pace, unless that is real time. PaceChange::factor.
  void set_pace(double factor, Time now);
  /// Ticks up to this one, not included, may start.
  void allow_until(std::uint64_t tick);
  /// Does what is due by the clock, and tries waiting writes again.
  void poll(Time now);
  /// When poll() should be called next; none: when something has arrived.
  std::optional<Time> next_due() const;

  /// May be read by any thread, also while the node is replaced.
  const std::string& name() const { return name_; }
  bool starts_ticks() const { return node_.ports().delayed_inputs.any(); }
  /// Whether a step is under way. Does not wait for it.
  bool is_stepping() const { return stepping_.is_busy(); }
  /// BusyThread's, of that step.
  std::uint64_t processor_ns() const { return stepping_.processor_ns(); }
  /// How long its last steps took. Does not wait for one that is under way.
  StepTimes step_times() const { return steps_.times(); }
  /// Reports progress, and hands over what is spooled.
  void flush();
  /// Hands over what the node writes from now on, and states, as shows_states() has it.
  void spool();
  /// What the node wrote, if it has stepped `last_tick` and every write was taken; else none yet.
  std::optional<Finished> finished(std::uint64_t last_tick) const;

 private:
  struct Output {
    std::unique_ptr<SampleWriter> writer;
    std::deque<std::string> waiting;
  };

  template <typename Message>
  std::unique_ptr<SampleListener> listener(const StartBarrier& barrier);
  template <typename Message>
  void deliver(Message& message);
  void refuse(domain::Topic topic, const core::Error& error);
  void tell(const char* kind, std::string text) const;
  void tell_sensor(std::optional<ScanWatch::News> news) const;
  void run_ready(Time now);
  bool may_step(Time now) const;
  void step();
  void publish();
  void write(Output& output, runtime::Topic topic, std::string_view cdr);
  void report();
  void save_checkpoint();
  void keep_tick(std::uint64_t tick, const runtime::TopicSet& present);
  void note_successions(std::uint64_t tick);
  core::Result<void> feed_past(const Checkpoint& checkpoint);

  mutable std::mutex mutex_;
  runtime::NodeSuccession node_;
  const std::string name_;
  domain::ScanLayout scan_layout_;
  /// Of the stage that steers, if it reads scans: it sees what the robot is driven by.
  std::optional<ScanWatch> scan_watch_;
  const std::string user_data_;
  const int history_depth_;
  const bool lockstep_;
  const double tick_s_;
  const bool spools_states_;
  std::optional<std::uint64_t> shown_from_;  ///< the tick from which on somebody looks on anew
  const bool waits_for_go_;
  const bool has_lead_;
  Handlers handlers_;
  runtime::InputBuffer buffer_;
  domain::Messages messages_;
  Codecs codecs_;
  SampleAccount account_;
  TickClock clock_;
  BusyThread stepping_;
  RecentSteps steps_;
  bool started_ = false;
  CommandGate gate_;      ///< before delayed inputs, in real time
  bool stopped_ = false;  ///< a write failed, or the run has its outcome
  std::uint64_t allowed_until_ = 0;
  std::optional<std::uint64_t> held_at_;   ///< it starts no tick from this one on
  std::multiset<std::uint64_t> expected_;  ///< ticks of successors that are still being made
  std::optional<InputHistory> history_;
  std::uint64_t refused_samples_ = 0;
  std::array<Output, domain::kTopicCount> outputs_;
  std::vector<std::unique_ptr<SampleListener>> listeners_;
  std::vector<std::unique_ptr<SampleReader>> readers_;  // closed before the listeners go
};

}  // namespace clew::bridge
