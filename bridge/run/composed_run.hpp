// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "run/pace.hpp"
#include "run/run_profile.hpp"
#include "run/run_report.hpp"
#include "run/sample_account.hpp"
#include "run/sample_sink.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// How to run a plan in one thread of this process.
struct ComposedLayout {
  Pace pace = Pace::kLockstep;
  double pace_factor = 1.0;
  bool hash = true;
  OnRecordError on_record_error = OnRecordError::kStop;
  RunProfile* profile = nullptr;  ///< told where the time goes; null: nobody asks
};

/// Of the components of a plan, in the order of their steps.
RunProfile profile_of(const runtime::RunPlan& plan);

/// A run that is under way: what has been is not run again.
struct ComposedStart {
  std::vector<runtime::NodeSuccession>
      nodes;  ///< in the order of the graph; have stepped every earlier tick
  std::uint64_t next_tick = 0;
  domain::Messages messages;  ///< the samples of the tick before
  SampleAccount account;      ///< of all earlier ticks
  std::chrono::steady_clock::time_point started_at;
};

/// What people and programs want of a composed run while it goes on.
class ComposedOrders {
 public:
  virtual ~ComposedOrders() = default;
  /// Looks what has arrived, between two ticks: may add successors to `nodes` for `next_tick` and
  /// later. With `recording` it records what it does. Waits up to `patience` for something.
  virtual void serve(std::uint64_t next_tick, std::vector<runtime::NodeSuccession>& nodes,
                     SampleSink* recording, std::chrono::milliseconds patience) = 0;
  /// All nodes have stepped `tick`; `messages` are its samples.
  virtual void note(std::uint64_t tick, const std::vector<runtime::NodeSuccession>& nodes,
                    const domain::Messages& messages) = 0;
  /// Whether `tick` may begin.
  virtual bool may_begin(std::uint64_t tick) const = 0;
  /// Why the run is to end; empty if it is not.
  virtual std::string stopped() const = 0;
  /// Another pace from now on, if somebody wants one since the last call: simulated over wall-clock
  /// time, 0 for no limit.
  virtual std::optional<double> take_pace() { return std::nullopt; }
  /// Who is to be told where the time goes from now on; null: nobody asks.
  virtual RunProfile* profile() { return nullptr; }
};

/// Runs a plan composed, until it has an outcome or SIGINT or SIGTERM arrives. Samples are
/// serialised only for the hash and the recording. `recording`, `display` and `orders` may be null.
core::Result<RunReport> run_composed(const runtime::RunPlan& plan, const ComposedLayout& layout,
                                     SampleSink* recording, const ProgressDisplay& display,
                                     ComposedOrders* orders = nullptr);

/// The same from `start`. `recording` gets only what is run.
core::Result<RunReport> run_composed(const runtime::RunPlan& plan, ComposedStart start,
                                     const ComposedLayout& layout, SampleSink* recording,
                                     const ProgressDisplay& display,
                                     ComposedOrders* orders = nullptr);

}  // namespace clew::bridge
